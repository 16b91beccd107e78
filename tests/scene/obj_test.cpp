#include <welkin/scene/obj.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tests/image/prefixes.h>
#include <tests/scene/scene_files.h>
#include <welkin/error.h>
#include <welkin/image/byte_image.h>
#include <welkin/image/codecs/ldr.h>

namespace welkin {
namespace {

SceneBytes resolve_files(const std::string& reference) {
  if (reference == "quad.mtl") return to_bytes(quad_mtl());
  if (reference == "paint map.png") return encode_png(ByteImage(2, 2));
  throw Error(reference, "no such file");
}

Scene decode(const std::string& text) { return decode_obj(to_bytes(text), "test", resolve_files); }

std::string error_of(const std::string& text) {
  return refusal(to_bytes(text),
                 [](std::span<const std::uint8_t> bytes) { decode_obj(bytes, "test", resolve_files); });
}

TEST(Obj, QuadIsExact) {
  const Scene scene = decode(quad_obj());
  ASSERT_EQ(scene.meshes.size(), 2u);
  const Mesh& quad = scene.meshes.at(0);
  EXPECT_EQ(quad.name, "first");
  ASSERT_EQ(quad.positions.size(), 4u);
  EXPECT_EQ(quad.positions[2], (Vec3f{2, 2, 0}));
  EXPECT_EQ(quad.positions[3], (Vec3f{0, 2, 0}));
  EXPECT_EQ(quad.normals[1], (Vec3f{0, 0, 1}));
  EXPECT_EQ(quad.texcoords[0][0].y, 1);  // v = 0 is the bottom
  EXPECT_EQ(quad.texcoords[0][2].x, 1);
  EXPECT_EQ(quad.texcoords[0][2].y, 0);
  EXPECT_EQ(quad.triangles.size(), 2u);
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{"there is no material \"missing\"", "points and lines are left out"}));
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[0]];
    area += cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a).z / 2.0;
  }
  return area;
}

// A square of which a corner between two others is pulled in: a fan would cover what is outside.
TEST(Obj, PolygonsThatAreNotConvex) {
  const Mesh mesh = decode(quad_obj()).meshes.at(1);
  EXPECT_EQ(mesh.triangles.size(), 3u);
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[0]];
    EXPECT_GT(cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a).z, 0);
  }
  EXPECT_DOUBLE_EQ(area_of(mesh), 1 - 0.5 * 0.75);
  EXPECT_EQ(mesh.normals[0], (Vec3f{0, 0, 1}));  // smooth, by s 1
}

TEST(Obj, MaterialsOfMtl) {
  const Scene scene = decode(quad_obj());
  ASSERT_EQ(scene.materials.size(), 3u);
  const Material& paint = scene.materials[0];
  EXPECT_EQ(scene.meshes[0].material, 0);
  EXPECT_EQ(paint.base_color.b, 1);
  EXPECT_EQ(paint.ior, 1.25f);
  EXPECT_EQ(paint.base_alpha, 0.5f);
  EXPECT_EQ(paint.emission.g, 2);
  EXPECT_FLOAT_EQ(paint.perceptual_roughness, 0.5f);  // alpha^2 = 2 / 32
  EXPECT_EQ(paint.metallic, 0);
  EXPECT_EQ(paint.base_color_texture.scale.y, 3);
  EXPECT_EQ(paint.base_color_texture.offset.x, 0.5f);
  EXPECT_EQ(paint.base_color_texture.offset.y, 1 - 3 - 0.25f);  // both ways of v
  EXPECT_EQ(scene.textures[0].wrap_u, TextureWrap::clamp);
  EXPECT_EQ(scene.materials[1].perceptual_roughness, 0.125f);
  EXPECT_EQ(scene.materials[1].metallic, 1);
  EXPECT_EQ(scene.materials[1].ior, 1);
  EXPECT_EQ(scene.materials[2].name, "default");
  EXPECT_EQ(scene.meshes[1].material, 2);
}

const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST(Obj, SmoothingGroupsJoinNormals) {
  // Two faces at a right angle: apart without a group, one bisecting normal on their edge within one.
  const Mesh flat = decode(corner + "f 1 2 3\nf 1 4 2\n").meshes.at(0);
  EXPECT_TRUE(flat.normals.empty());
  const Mesh smooth = decode(corner + "s 1\nf 1 2 3\nf 1 4 2\n").meshes.at(0);
  ASSERT_EQ(smooth.positions.size(), 4u);
  EXPECT_FLOAT_EQ(smooth.normals[0].z, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(smooth.normals[0].y, std::sqrt(0.5f));
  EXPECT_FLOAT_EQ(smooth.normals[2].z, 1);
  const Mesh apart = decode(corner + "s 1\nf 1 2 3\ns 2\nf 1 4 2\n").meshes.at(0);
  EXPECT_EQ(apart.positions.size(), 6u);
  EXPECT_FLOAT_EQ(apart.normals[0].z, 1);
}

TEST(Obj, WhatIsWrongIsSaid) {
  EXPECT_EQ(error_of(corner + "f 1 2 5\n"), "test: a face uses vertex 5 of 4");
  EXPECT_EQ(error_of(corner + "f 1 2 -5\n"), "test: line 5: a face uses vertex -5 of 4");
  EXPECT_EQ(error_of(corner + "f 1 2 0\n"), "test: line 5: a face uses vertex 0 of 4");
  EXPECT_EQ(error_of(corner + "f 1 2\n"), "test: line 5: a face has fewer than 3 vertices");
  EXPECT_EQ(error_of(corner + "f 1 2 x\n"), "test: line 5: \"x\" is not an index");
  EXPECT_EQ(error_of(corner + "f 1/1 2/1 3/1\n"), "test: a face uses texture coordinate 1 of 0");
  EXPECT_EQ(error_of("v 0 nan 0\n"), "test: line 1: \"nan\" is not a finite number");
  EXPECT_EQ(error_of("v 0 1e39 0\n"), "test: line 1: \"1e39\" is not a finite number");
  EXPECT_EQ(error_of("v 0 0\n"), "test: line 1: a number is missing");
  EXPECT_EQ(error_of(""), "test: has no vertices: not an OBJ file, or an empty one");
  EXPECT_EQ(error_of(corner), "test: has no triangles to show");
  EXPECT_EQ(error_of(corner + "f 1 1 1\n"), "test: has no triangles to show");
}

TEST(Obj, MissingTexturesAreErrorsMissingMaterialsWarnings) {
  const auto with = [](const std::string& mtl) {
    return [mtl](const std::string& reference) -> SceneBytes {
      if (reference == "m.mtl" && !mtl.empty()) return to_bytes(mtl);
      throw Error(reference, "no such file");
    };
  };
  const SceneBytes text = to_bytes("mtllib m.mtl\n" + corner + "f 1 2 3\n");
  EXPECT_EQ(decode_obj(text, "test", with("")).warnings,
            (std::vector<std::string>{"the material file \"m.mtl\" cannot be read"}));
  EXPECT_EQ(refusal(text, [&](auto bytes) { decode_obj(bytes, "test", with("newmtl a\nmap_Kd a.png\n")); }),
            "test: m.mtl: line 2: refers to a texture that cannot be read: a.png: no such file");
}

// A cut can leave a valid file; never anything but a scene or one clear line.
TEST(Obj, EveryPrefixIsReadOrRefused) {
  const SceneBytes bytes = to_bytes(quad_obj());
  int refused = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const std::string message =
        refusal(std::span(bytes).first(size), [](auto part) { decode_obj(part, "test", resolve_files); });
    refused += message == "(accepted)" ? 0 : 1;
    ASSERT_TRUE(message == "(accepted)" || message.starts_with("test: ")) << size << ": " << message;
    ASSERT_EQ(message.find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, 100);  // all that end before the first face
}

}  // namespace
}  // namespace welkin
