#include <welkin/scene/ply.h>

#include <gtest/gtest.h>

#include <tests/image/prefixes.h>
#include <tests/scene/scene_files.h>

namespace welkin {
namespace {

void decode_bytes(std::span<const std::uint8_t> bytes) { decode_ply(bytes, "test"); }

std::string error_of(const std::string& text) { return refusal(to_bytes(text), decode_bytes); }

TEST(Ply, AsciiIsExact) {
  const Scene scene = decode_ply(to_bytes(quad_ply_ascii()), "test");
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[2], (Vec3f{2, 2, 0}));
  EXPECT_EQ(mesh.texcoords[0][1].x, 1);
  EXPECT_EQ(mesh.texcoords[0][1].y, 1);  // t = 0 is the bottom
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(scene.warnings, (std::vector<std::string>{"vertex colors are not used"}));
}

TEST(Ply, BothByteOrdersAreExact) {
  for (const bool big_endian : {false, true}) {
    const Scene scene = decode_ply(quad_ply_binary(big_endian), "test");
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[1], (Vec3f{0, 2, 0}));
    EXPECT_EQ(mesh.normals[0], (Vec3f{0, 0, 1}));  // of length 2 in the file
    using Triangles = std::vector<std::array<std::uint32_t, 3>>;
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 2, 1}, {1, 2, 3}})) << "strip";
  }
}

TEST(Ply, EveryPrefixIsRefused) {
  std::string ascii = quad_ply_ascii();
  ascii.pop_back();  // its end of line says nothing
  expect_every_prefix_refused(to_bytes(ascii), "test", decode_bytes);
  expect_every_prefix_refused(quad_ply_binary(false), "test", decode_bytes);
  expect_every_prefix_refused(quad_ply_binary(true), "test", decode_bytes);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Ply, WhatIsWrongIsSaid) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return error_of(replaced(quad_ply_ascii(), from, to));
  };
  EXPECT_EQ(refused("7 4 0 1 2 3", "7 4 0 1 2 4"), "test: a face uses vertex 4 of 4");
  EXPECT_EQ(refused("7 4 0 1 2 3", "7 4 0 1 2 -1"), "test: a face uses vertex -1 of 4");
  EXPECT_EQ(refused("2 2 0 255", "2 nan 0 255"), "test: vertex 2: a value is not finite");
  EXPECT_EQ(refused("2 2 0 255", "2 two 0 255"), "test: \"two\" is not a number");
  EXPECT_EQ(refused("element vertex 4", "element vertex 4000000000000"),
            "test: is cut off: 4000000000000 elements \"vertex\" do not fit into what is left of it");
  EXPECT_EQ(refused("element vertex 4", "element point 4"), "test: has no vertices");
  EXPECT_EQ(refused("property double y", "property real y"), "test: line 6: \"real\" is not a type of PLY");
  EXPECT_EQ(refused("format ascii 1.0", "format ascii 2.0"), "test: line 2: only PLY 1.0 is read");
  EXPECT_EQ(refused("vertex_indices", "corners"), "test: its faces have no list vertex_indices");
  EXPECT_EQ(refused("7 4 0 1 2 3", "7 2 0 1"), "test: has no triangles to show");
  EXPECT_EQ(error_of("solid cube"), "test: not a PLY file");
}

}  // namespace
}  // namespace welkin
