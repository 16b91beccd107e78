#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

// Small scene files, as text or bytes, that the tests and the fuzzers' seeds share.

namespace welkin {

using SceneBytes = std::vector<std::uint8_t>;

inline SceneBytes to_bytes(std::string_view text) { return {text.begin(), text.end()}; }

/// Numbers as little-endian bytes, one after the other.
class Packed {
 public:
  Packed& floats(std::initializer_list<float> values);
  Packed& u8(std::initializer_list<int> values);
  Packed& u16(std::initializer_list<int> values);
  Packed& u32(std::initializer_list<std::uint32_t> values);
  const SceneBytes& bytes() const { return bytes_; }
  std::size_t size() const { return bytes_.size(); }

 private:
  void append(const void* from, std::size_t size);
  SceneBytes bytes_;
};

std::string base64(const SceneBytes& bytes);

/// A GLB with a JSON and a binary chunk, padded as they must be.
SceneBytes glb_file(std::string json, SceneBytes binary);

/// A textured, normal-mapped quad of two triangles with everything that a quad can have: its JSON refers to one buffer,
/// `buffer` ("" for a GLB's), which is quad_buffer().
std::string quad_gltf(const std::string& buffer_uri);
SceneBytes quad_buffer();

/// A quad and a pentagon with normals, texture coordinates and a material; and its material file "quad.mtl".
std::string quad_obj();
std::string quad_mtl();

/// A quad; binary ones of either order.
std::string quad_ply_ascii();
SceneBytes quad_ply_binary(bool big_endian);

}  // namespace welkin
