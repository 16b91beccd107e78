#include <welkin/scene/shapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

struct Sums {
  double volume = 0;  // of what the front sides look out of
  double area = 0;
};

Sums sums_of(const Mesh& mesh) {
  Sums sums;
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    sums.volume += dot(a, cross(b, c)) / 6;
    sums.area += length(cross(b - a, c - a)) / 2;
  }
  return sums;
}

// Normals are on the triangles' front side, and the texture runs along them as the tangents say.
void expect_consistent(const Mesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const Vec3f e1 = mesh.positions[t[1]] - mesh.positions[t[0]],
                e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
    const auto& uv = mesh.texcoords[0];
    const Vec2f d1 = uv[t[1]] - uv[t[0]], d2 = uv[t[2]] - uv[t[0]];
    const float area = d1.x * d2.y - d1.y * d2.x;
    const Vec3f along_u = (1 / area) * (d2.y * e1 - d1.y * e2),
                along_v = (1 / area) * (d1.x * e2 - d2.x * e1);
    for (std::uint32_t i : t) {
      EXPECT_GT(dot(mesh.normals[i], cross(e1, e2)), 0);
      EXPECT_GT(dot(mesh.tangents[i], along_u), 0);
      // The bitangent points up in the texture, where v falls.
      const Vec3f bitangent = mesh.tangent_signs[i] * cross(mesh.normals[i], mesh.tangents[i]);
      EXPECT_LT(dot(bitangent, along_v), 0);
      EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-6f);
      EXPECT_NEAR(length(mesh.tangents[i]), 1, 1e-6f);
      EXPECT_NEAR(dot(mesh.normals[i], mesh.tangents[i]), 0, 1e-6f);
    }
  }
}

TEST(Shapes, RectangleFacesWhereAcrossTimesUpPoints) {
  const Mesh mesh = make_rectangle({1, 2, 3}, {2, 0, 0}, {0, 0, -4});
  expect_consistent(mesh);
  EXPECT_EQ(mesh.normals[0], (Vec3f{0, 1, 0}));
  EXPECT_EQ(mesh.positions[2], (Vec3f{3, 2, -1}));
  EXPECT_EQ(mesh.texcoords[0][2].x, 1);
  EXPECT_EQ(mesh.texcoords[0][2].y, 0);
  EXPECT_EQ(sums_of(mesh).area, 8);
}

TEST(Shapes, BoxIsClosedAndFacesOutwards) {
  const Mesh mesh = make_box({-1, 0, 2}, {1, 3, 7});
  expect_consistent(mesh);
  EXPECT_NEAR(sums_of(mesh).volume, 30, 1e-5);
  EXPECT_EQ(sums_of(mesh).area, 2 * (2 * 3 + 3 * 5 + 2 * 5));
}

// The second law of Pappus; chords shorten both circles by about (pi / 100)^2 * 2 / 3 = 7e-4.
TEST(Shapes, TorusHasItsVolume) {
  const Mesh mesh = make_torus(2, 0.5f, 100, 100);
  expect_consistent(mesh);
  const double volume = 2 * std::numbers::pi * 2 * std::numbers::pi * 0.25;
  EXPECT_NEAR(sums_of(mesh).volume / volume, 1, 2e-3);
}

TEST(Shapes, LatheHasNoTrianglesWithoutAreaAtItsPoles) {
  const Mesh mesh = make_lathe({{{0, -1}, {0, -1}}, {{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}}, 5);
  EXPECT_EQ(mesh.triangles.size(), 10u);
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    EXPECT_GT(length(cross(b - a, c - a)), 0.1f);
  }
  EXPECT_GT(sums_of(mesh).volume, 0);
}

}  // namespace
}  // namespace welkin
