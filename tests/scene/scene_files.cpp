#include <tests/scene/scene_files.h>

#include <algorithm>
#include <cstring>

#include <welkin/image/byte_image.h>
#include <welkin/image/codecs/ldr.h>

namespace welkin {

void Packed::append(const void* from, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(from);
  for (std::size_t i = 0; i < size; ++i) bytes_.push_back(bytes[i]);
}

Packed& Packed::floats(std::initializer_list<float> values) {
  for (float value : values) append(&value, sizeof value);
  return *this;
}

Packed& Packed::u8(std::initializer_list<int> values) {
  for (int value : values) bytes_.push_back(static_cast<std::uint8_t>(value));
  return *this;
}

Packed& Packed::u16(std::initializer_list<int> values) {
  for (int value : values) {
    const auto narrow = static_cast<std::uint16_t>(value);
    append(&narrow, sizeof narrow);
  }
  return *this;
}

Packed& Packed::u32(std::initializer_list<std::uint32_t> values) {
  for (std::uint32_t value : values) append(&value, sizeof value);
  return *this;
}

std::string base64(const SceneBytes& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

SceneBytes glb_file(std::string json, SceneBytes binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary.push_back(0);
  const auto json_size = static_cast<std::uint32_t>(json.size()),
             size = static_cast<std::uint32_t>(binary.size());
  SceneBytes file = Packed().u32({0x46546c67, 2, 28 + json_size + size, json_size, 0x4e4f534a}).bytes();
  file.insert(file.end(), json.begin(), json.end());
  const SceneBytes head = Packed().u32({size, 0x004e4942}).bytes();
  file.insert(file.end(), head.begin(), head.end());
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

namespace {

SceneBytes small_png() {
  ByteImage image(2, 2, 3);
  for (std::size_t i = 0; i < 12; ++i) image.pixels[i] = static_cast<std::uint8_t>(20 * i);
  return encode_png(image);
}

}  // namespace

// Offsets: positions 0 (48 bytes), normals 48 (48, strided with the positions below), texcoords 96 (8, normalised bytes),
// indices 104 (12), the sparse accessor's index 116 (4) and value 120 (12).
SceneBytes quad_buffer() {
  return Packed()
      .floats({0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0})
      .floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})
      .u8({0, 255, 255, 255, 255, 0, 0, 0})
      .u16({0, 1, 2, 0, 2, 3})
      .u16({2, 0})
      .floats({2, 3, 0})
      .bytes();
}

std::string quad_gltf(const std::string& buffer_uri) {
  const std::string uri = buffer_uri.empty() ? "" : R"("uri":")" + buffer_uri + R"(",)";
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],
"extensionsUsed":["KHR_texture_transform","KHR_lights_punctual","KHR_materials_emissive_strength"],
"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,0.5,0.25],"intensity":4,
"spot":{"innerConeAngle":0.1,"outerConeAngle":0.5}}]}},
"nodes":[{"children":[1,2],"translation":[10,0,0],"rotation":[0,0.70710678,0,0.70710678]},
{"mesh":0,"translation":[1,2,3],"scale":[2,2,2]},{"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}},
{"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,-5,1]}],
"cameras":[{"name":"eye","type":"perspective","perspective":{"yfov":0.5,"znear":0.1,"aspectRatio":1.5}}],
"meshes":[{"name":"quad","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],
"materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.75],"metallicFactor":0.5,
"roughnessFactor":0.25,"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"scale":[2,3],
"rotation":0.25}}},"metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":0,"scale":0.5},
"emissiveFactor":[1,1,0.5],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3}},
"alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],
"images":[{"uri":"data:image/png;base64,)" +
         base64(small_png()) + R"("}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":4,"componentType":5123},"values":{"bufferView":5}}},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC2"},
{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48,"byteStride":12},
{"buffer":0,"byteOffset":96,"byteLength":8},{"buffer":0,"byteOffset":104,"byteLength":12},
{"buffer":0,"byteOffset":116,"byteLength":4},{"buffer":0,"byteOffset":120,"byteLength":12}],
"buffers":[{)" +
         uri + R"("byteLength":132}]})";
}

std::string quad_obj() {
  return "# a quad\nmtllib quad.mtl\no first\nv 0 0 0\nv 2 0 0\r\nv 2 2 0 1\nv 0 +2e0 0\nvt 0 0\nvt 1 0\nvt "
         "1 1\nvt 0 1\n"
         "vn 0 0 1\nusemtl paint\nf 1/1/1 2/2/1 \\\n 3/3/1 4/4/1\no second\ns 1\nv 5 0 0\nv 6 0 0\nv 6 1 "
         "0\nv 5.5 0.25 0\n"
         "v 5 1 0\nusemtl missing\nf -5 -4 -3 -2 -1\nl 1 2\n";
}

std::string quad_mtl() {
  return "newmtl paint\nKd 0.5 0.25 1\nKs 0.5\nNs 30\nNi 1.25\nd 0.5\nKe 0 2 0\nmap_Kd -s 2 3 1 -o 0.5 0.25 "
         "-clamp on "
         "paint map.png\nnewmtl other\nPr 0.125\nPm 1\nillum 1\n";
}

std::string quad_ply_ascii() {
  return "ply\nformat ascii 1.0\ncomment a quad\nelement vertex 4\nproperty float x\nproperty double y\n"
         "property float z\nproperty uchar red\nproperty float s\nproperty float t\nelement face 1\n"
         "property uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0 255 0 0\n2 0 0 255 1 0\n2 2 0 255 1 1\n0 2 0 255 0 1\n7 4 0 1 2 3\n";
}

SceneBytes quad_ply_binary(bool big_endian) {
  SceneBytes file =
      to_bytes(std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
               "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "property float nx\nproperty float ny\nproperty float nz\n"
               "element tristrips 1\nproperty list uint int vertex_index\nend_header\n");
  const auto add = [&](const auto& value) {
    std::uint8_t raw[4];
    std::memcpy(raw, &value, 4);
    if (big_endian) std::reverse(raw, raw + 4);
    for (std::uint8_t byte : raw) file.push_back(byte);
  };
  for (float x : {0.0f, 2.0f})
    for (float y : {0.0f, 2.0f})
      for (float value : {x, y, 0.0f, 0.0f, 0.0f, 2.0f}) add(value);
  add(std::uint32_t{6});
  for (std::int32_t i : {0, 2, 1, 3, -1, 0}) add(i);
  return file;
}

}  // namespace welkin
