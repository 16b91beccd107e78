#include <welkin/scene/gltf.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <tests/image/prefixes.h>
#include <tests/scene/scene_files.h>
#include <welkin/error.h>

namespace welkin {
namespace {

SceneBytes resolve_quad(const std::string& reference) {
  if (reference != "quad data.bin") throw Error(reference, "no such file");
  return quad_buffer();
}

Scene decode(const std::string& text) { return decode_gltf(to_bytes(text), "test", resolve_quad); }

std::string error_of(const std::string& text) {
  return refusal(to_bytes(text),
                 [](std::span<const std::uint8_t> bytes) { decode_gltf(bytes, "test", resolve_quad); });
}

void expect_near(Vec3f a, Vec3f b) {
  constexpr float rounding = 1e-5f;
  EXPECT_NEAR(a.x, b.x, rounding);
  EXPECT_NEAR(a.y, b.y, rounding);
  EXPECT_NEAR(a.z, b.z, rounding);
}

void expect_quad_mesh(const Scene& scene) {
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.name, "quad");
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[1], (Vec3f{2, 0, 0}));
  EXPECT_EQ(mesh.positions[2], (Vec3f{2, 3, 0}));  // the sparse one
  EXPECT_EQ(mesh.normals[3], (Vec3f{0, 0, 1}));
  EXPECT_EQ(mesh.texcoords[0][0].x, 0);
  EXPECT_EQ(mesh.texcoords[0][0].y, 1);
  EXPECT_EQ(mesh.texcoords[0][2].x, 1);
  EXPECT_TRUE(mesh.texcoords[1].empty());
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  // A normal map without tangents: in the first triangle, u grows along +x and the texture's up is +y.
  EXPECT_EQ(mesh.tangents[1], (Vec3f{1, 0, 0}));
  EXPECT_EQ(mesh.tangent_signs[1], 1);
}

TEST(Gltf, MeshIsExactFromEveryKindOfBuffer) {
  expect_quad_mesh(decode(quad_gltf("quad%20data.bin")));
  expect_quad_mesh(decode(quad_gltf("data:application/octet-stream;base64," + base64(quad_buffer()))));
  expect_quad_mesh(decode_gltf(glb_file(quad_gltf(""), quad_buffer()), "test", resolve_quad));
}

// A quarter turn about y takes x to -z and z to x.
TEST(Gltf, NodesPlaceInstancesCamerasAndLights) {
  const Scene scene = decode(quad_gltf("quad%20data.bin"));
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(scene.instances[0].to_world.origin, {13, 2, -1});
  expect_near(scene.instances[0].to_world.x, {0, 0, -2});
  expect_near(scene.instances[0].to_world.z, {2, 0, 0});
  expect_near(scene.instances[1].to_world.origin, {0, 0, -5});
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[0].vertical_field_radians, 0.5f);
  EXPECT_EQ(scene.cameras[0].width_over_height, 1.5f);
  expect_near(scene.cameras[0].to_world.origin, {10, 0, 0});
  expect_near(scene.cameras[0].to_world.z, {1, 0, 0});
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::spot);
  expect_near(scene.lights[0].direction, {-1, 0, 0});
  EXPECT_EQ(scene.lights[0].intensity.b, 1);
  EXPECT_EQ(scene.lights[0].inner_cone_radians, 0.1f);
}

TEST(Gltf, MaterialsAndTextures) {
  const Scene scene = decode(quad_gltf("quad%20data.bin"));
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.model, MaterialModel::metallic_roughness);
  EXPECT_EQ(m.base_color.g, 0.25f);
  EXPECT_EQ(m.base_alpha, 0.75f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.perceptual_roughness, 0.25f);
  EXPECT_EQ(m.emission.r, 3);
  EXPECT_EQ(m.emission.b, 1.5f);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.normal_scale, 0.5f);
  EXPECT_EQ(m.base_color_texture.offset.x, 0.5f);
  EXPECT_EQ(m.base_color_texture.scale.y, 3);
  EXPECT_EQ(m.base_color_texture.rotation_radians, 0.25f);
  EXPECT_EQ(m.metallic_texture.channel, 2);
  EXPECT_EQ(m.roughness_texture.channel, 1);
  // One image, once as colour and once as numbers.
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(m.metallic_texture.texture, m.normal_texture.texture);
  const Texture& color = scene.textures[m.base_color_texture.texture];
  const Texture& numbers = scene.textures[m.normal_texture.texture];
  EXPECT_EQ(numbers.image.pixels[5], 100.0f / 255);
  EXPECT_LT(color.image.pixels[5], numbers.image.pixels[5]);
  EXPECT_EQ(color.wrap_u, TextureWrap::clamp);
  EXPECT_EQ(color.wrap_v, TextureWrap::mirror);
  EXPECT_TRUE(color.nearest);
}

// One triangle list, strip or fan over the same five vertices.
std::string shape_gltf(const std::string& primitive) {
  const SceneBytes buffer = Packed().floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 1, 0, 2, 2, 1}).bytes();
  return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0})" +
         primitive +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":60}],"buffers":[{"byteLength":60,"uri":"data:;base64,)" +
         base64(buffer) + R"("}]})";
}

TEST(Gltf, StripsAndFans) {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  EXPECT_EQ(decode(shape_gltf(R"(,"mode":5)")).meshes[0].triangles,
            (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(decode(shape_gltf(R"(,"mode":6)")).meshes[0].triangles,
            (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  // The list leaves two vertices over, which are not kept.
  const Scene list = decode(shape_gltf(""));
  EXPECT_EQ(list.meshes[0].triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(list.meshes[0].normals.empty());
  EXPECT_EQ(list.materials[0].name, "default");
  EXPECT_EQ(error_of(shape_gltf(R"(,"mode":1)")), "test: has no triangles to show");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Gltf, WhatIsWrongIsSaid) {
  const std::string quad = quad_gltf("quad%20data.bin");
  const auto refused = [&](const std::string& from, const std::string& to) {
    return error_of(replaced(quad, from, to));
  };
  EXPECT_EQ(refused("quad%20data.bin", "gone.bin"),
            "test: refers to a file that cannot be read: gone.bin: no such file");
  EXPECT_EQ(refused("\"uri\":\"quad%20data.bin\",", ""),
            "test: buffer 0 is missing: it has no uri and is no binary chunk");
  EXPECT_EQ(refused("\"byteLength\":132", "\"byteLength\":133"),
            "test: buffer 0 is cut off: it has 132 of 133 bytes");
  EXPECT_EQ(refused("\"byteOffset\":104,\"byteLength\":12", "\"byteOffset\":104,\"byteLength\":10"),
            "test: accessor 3: reaches beyond its buffer view");
  EXPECT_EQ(refused("\"indices\":3", "\"indices\":4"), "test: mesh 0: indices 4 does not exist, there are 4");
  EXPECT_EQ(refused("\"indices\":3", "\"indices\":0"),
            "test: accessor 0: indices are unsigned integers, one each");
  EXPECT_EQ(refused("\"mesh\":0,\"trans", "\"mesh\":1,\"trans"),
            "test: node 1: mesh 1 does not exist, there are 1");
  EXPECT_EQ(refused("\"children\":[1,2]", "\"children\":[1,0]"),
            "test: node 0 has two parents or is its own ancestor");
  EXPECT_EQ(refused("\"children\":[1,2]", "\"children\":[9]"),
            "test: node 0: refers to a node that does not exist, there are 4");
  EXPECT_EQ(refused("\"version\":\"2.0\"", "\"version\":\"1.0\""), "test: glTF 1.0 is not read, only 2.0");
  EXPECT_EQ(refused("\"source\":0", "\"source\":7"), "test: texture 0: source 7 does not exist, there are 1");
  EXPECT_EQ(refused("data:image/png;base64,", "none.png?"),
            error_of(replaced(quad, "data:image/png;base64,", "none.png?")));
  EXPECT_EQ(refused("\"metallicFactor\":0.5", "\"metallicFactor\":2"),
            "test: material 0 \"paint\": its metallic factor is not in [0, 1]");
  EXPECT_EQ(
      refused("\"count\":4,\"type\":\"VEC3\",\"sparse\"", "\"count\":1e15,\"type\":\"VEC3\",\"sparse\""),
      "test: accessor 0: its count is above 2^32");
  EXPECT_EQ(refused("\"extensionsUsed\"",
                    "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"extensionsUsed\""),
            "test: needs the extension KHR_draco_mesh_compression, which welkin does not read");
  EXPECT_EQ(refused("\"scale\":[2,2,2]", "\"scale\":[2,2]"),
            "test: node 1: scale is not an array of 3 numbers");
  EXPECT_EQ(refused("\"scale\":[2,2,2]", "\"scale\":[2,2,1e39]"),
            "test: node 1: scale has a number that is too large");
}

// An accessor without a view is all zeros and can be of any length; memory for it is not taken.
TEST(Gltf, ZerosOutOfNothingAreRefused) {
  const std::string text = replaced(shape_gltf(""), "\"bufferView\":0,\"componentType\":5126,\"count\":5",
                                    "\"componentType\":5126,\"count\":4000000000");
  EXPECT_EQ(error_of(text), "test: asks for more than 64 times its size in vertices");
}

TEST(Gltf, NotANumberIsRefused) {
  SceneBytes buffer = quad_buffer();
  const SceneBytes nan = Packed().floats({NAN}).bytes();
  std::copy(nan.begin(), nan.end(), buffer.begin() + 16);
  EXPECT_EQ(error_of(quad_gltf("data:;base64," + base64(buffer))), "test: mesh 0: a position is not finite");
}

TEST(Gltf, AnIndexBeyondTheVerticesIsRefused) {
  SceneBytes buffer = quad_buffer();
  buffer[104] = 4;
  EXPECT_EQ(error_of(quad_gltf("data:;base64," + base64(buffer))),
            "test: mesh 0: a triangle uses vertex 4 of 4");
}

TEST(Gltf, FlatTrianglesAreDroppedWithAWarning) {
  SceneBytes buffer = quad_buffer();
  buffer[104] = 1;  // 1, 1, 2
  const Scene scene = decode(quad_gltf("data:;base64," + base64(buffer)));
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_EQ(scene.warnings, (std::vector<std::string>{"1 triangles without area were dropped"}));
}

TEST(Gltf, FlatInstancesAreLeftOutWithAWarning) {
  const Scene scene =
      decode(replaced(quad_gltf("quad%20data.bin"), "\"scale\":[2,2,2]", "\"scale\":[2,0,2]"));
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{"1 instances are flattened by their transform and left out"}));
}

TEST(Gltf, EveryPrefixIsRefused) {
  const auto decode_bytes = [](std::span<const std::uint8_t> bytes) {
    decode_gltf(bytes, "test", resolve_quad);
  };
  expect_every_prefix_refused(to_bytes(quad_gltf("quad%20data.bin")), "test", decode_bytes);
  expect_every_prefix_refused(glb_file(quad_gltf(""), quad_buffer()), "test", decode_bytes);
}

TEST(Gltf, DeepNestingIsRefused) {
  EXPECT_EQ(error_of(std::string(100000, '[')), "test: its JSON is nested more than 64 deep");
}

// Ten thousand nodes in a chain, each one metre further: no recursion.
TEST(Gltf, LongChainsOfNodes) {
  std::string nodes;
  for (int i = 0; i < 10000; ++i)
    nodes += R"({"translation":[1,0,0],"children":[)" + std::to_string(i + 1) + "]},";
  const Scene scene = decode(replaced(shape_gltf(""), R"({"mesh":0})", nodes + R"({"mesh":0})"));
  EXPECT_EQ(scene.instances[0].to_world.origin.x, 10000);
}

TEST(Gltf, ManyInstancesOfOneNode) {
  const SceneBytes buffer = Packed().floats({0, 0, 0, 5, 0, 0, 0, 7, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}).bytes();
  std::string text = replaced(shape_gltf(""), R"({"mesh":0})",
                              R"({"mesh":0,"translation":[0,0,1],"extensions":{"EXT_mesh_gpu_instancing":)"
                              R"({"attributes":{"TRANSLATION":1,"SCALE":2}}}})");
  text = replaced(text, R"("type":"VEC3"})",
                  R"("type":"VEC3"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
                  R"({"bufferView":1,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"})");
  text = replaced(text, R"("byteLength":60})", R"("byteLength":60},{"buffer":1,"byteLength":72})");
  text = replaced(text, "\"}]}", R"("},{"byteLength":72,"uri":"data:;base64,)" + base64(buffer) + R"("}]})");
  const std::string message = error_of(text);
  ASSERT_EQ(message, "(accepted)") << text;
  const Scene scene = decode(text);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[2].to_world.origin, (Vec3f{0, 7, 1}));
  EXPECT_EQ(scene.instances[1].to_world.y, (Vec3f{0, 2, 0}));
}

TEST(Gltf, PicturesThatSomebodyElseDecodedAreTaken) {
  ByteImage picture(1, 1, 4);
  picture.pixels = {255, 0, 51, 102};
  // What the file holds is not even looked at.
  std::string text = quad_gltf("quad%20data.bin");
  text = replaced(text, "data:image/png;base64,", "none.png?");
  const Scene scene = decode_gltf(to_bytes(text), "test", resolve_quad, {{0, picture}});
  const Material& m = scene.materials[0];
  const Image& color = scene.textures[m.base_color_texture.texture].image;
  const Image& numbers = scene.textures[m.normal_texture.texture].image;
  EXPECT_EQ(color.channels, 4);
  EXPECT_EQ(color.pixels[0], 1);
  EXPECT_NEAR(color.pixels[2], 0.0331f, 1e-4f);  // 0.2 through the sRGB curve
  EXPECT_EQ(numbers.pixels[2], 0.2f);
  EXPECT_EQ(color.pixels[3], 0.4f);  // alpha is no colour
}

}  // namespace
}  // namespace welkin
