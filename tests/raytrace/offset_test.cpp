#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <welkin/raytrace/flush_denormals.h>
#include "tests/raytrace/shapes.h"

// Rays that leave surfaces: they must neither meet the surface that they leave nor miss what touches it.

namespace welkin {
namespace {

using namespace oracle;

struct Place {
  float scale;
  Vec3f origin;
};
// Sizes from a millimetre to 100 km, at the origin and far from it.
const std::vector<Place> places = {{1e-3f, {}},         {1, {}},
                                   {1e5f, {}},          {1e-3f, {0.1f, -0.2f, 0.3f}},
                                   {1, {100, -50, 70}}, {10, {1e5f, 3e4f, -8e4f}}};

// A turn that is no multiple of anything, so that no coordinate is exact.
Affine turned(const Place& p) {
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  return {{p.scale * c, 0, -p.scale * s},
          {p.scale * s * 0.6f, p.scale * 0.8f, p.scale * c * 0.6f},
          {p.scale * s * 0.8f, -p.scale * 0.6f, p.scale * c * 0.8f},
          p.origin};
}

// Walks through a closed room: from each wall's point on in a random direction above it. Every ray must arrive at a wall,
// seen from inside, and not at once at the same triangle.
void walk_inside(const Scene& scene, Vec3f start, bool from_inside, int steps) {
  const RayScene rays(scene);
  const FlushDenormals flush;
  std::mt19937 random(7);
  Ray r{start, 0, random_direction(random), 1e30f};
  int lost = 0, wrong_side = 0, same = 0;
  std::optional<Hit> before;
  for (int i = 0; i < steps; ++i) {
    const auto hit = rays.closest(r);
    lost += !hit || !rays.occluded(r);
    if (!hit) break;
    const Surface s = surface_at(rays, *hit, r);
    wrong_side += s.front == from_inside;
    same +=
        before && before->object == hit->object && before->triangle == hit->triangle && scene.spheres.empty();
    before = hit;
    Vec3f d = random_direction(random);
    while (dot(d, s.geometric_normal) == 0) d = random_direction(random);  // leaves neither side
    if ((dot(d, s.geometric_normal) > 0) == from_inside) d = -d;
    r = {leave_surface(s, d), 0, d, 1e30f};
  }
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong_side, 0);
  EXPECT_EQ(same, 0);
}

TEST(Offsets, AClosedRoomStaysClosed) {
  for (const Place& p : places) {
    SCOPED_TRACE(testing::Message() << "scale " << p.scale << " at " << p.origin.x);
    walk_inside(scene_of(cube_mesh(), {turned(p)}), p.origin, true, 120'000);
  }
}

TEST(Offsets, AClosedRoomStaysClosedAlignedWithTheAxes) {
  for (const Place& p : places) {
    SCOPED_TRACE(testing::Message() << "scale " << p.scale << " at " << p.origin.x);
    walk_inside(scene_of(cube_mesh(), {scaled(p.scale, p.origin)}), p.origin, true, 120'000);
  }
}

TEST(Offsets, AClosedRoomStaysClosedThroughAnInstance) {
  for (const Place& p : places) {
    SCOPED_TRACE(testing::Message() << "scale " << p.scale << " at " << p.origin.x);
    const Affine second = scaled(p.scale, p.origin + Vec3f{10 * p.scale, 0, 0});
    walk_inside(scene_of(cube_mesh(), {turned(p), second}), p.origin, true, 120'000);
  }
}

TEST(Offsets, AMirroredRoomHasItsFrontsOutside) {
  Affine mirrored = turned({2, {3, 4, 5}});
  mirrored.x = -mirrored.x;
  walk_inside(scene_of(cube_mesh(), {mirrored}), {3, 4, 5}, true, 100'000);
  walk_inside(scene_of(cube_mesh(), {mirrored, scaled(1, {50, 0, 0})}), {3, 4, 5}, true, 100'000);
}

TEST(Offsets, AFineMeshStaysClosed) { walk_inside(scene_of(icosphere(5)), {}, true, 120'000); }

TEST(Offsets, ASphereStaysClosedFromInside) {
  for (const Place& p : places) {
    Scene scene;
    scene.materials.push_back({});
    scene.spheres.push_back({p.origin, p.scale, 0});
    walk_inside(scene, p.origin, true, 200'000);
  }
}

// From a convex surface outwards nothing is ever met.
TEST(Offsets, ConvexSurfacesDoNotShadowThemselves) {
  const FlushDenormals flush;
  std::mt19937 random(8);
  for (const Place& p : places) {
    SCOPED_TRACE(testing::Message() << "scale " << p.scale << " at " << p.origin.x);
    std::vector<Scene> scenes = {
        scene_of(icosphere(2), {turned(p)}),
        scene_of(icosphere(2), {turned(p), scaled(p.scale, p.origin + Vec3f{1e6f * p.scale, 0, 0})})};
    Scene sphere;
    sphere.materials.push_back({});
    sphere.spheres.push_back({p.origin, p.scale, 0});
    scenes.push_back(sphere);
    for (const Scene& scene : scenes) {
      const RayScene rays(scene);
      int shadowed = 0, met = 0;
      for (int i = 0; i < 40'000; ++i) {
        const Vec3f eye = p.origin + 3 * p.scale * random_direction(random);
        const Vec3f aim = p.origin + 0.9f * p.scale * random_direction(random);
        const Ray r{eye, 0, normalized(aim - eye), 1e30f};
        const auto hit = rays.closest(r);
        if (!hit) continue;
        ++met;
        const Surface s = surface_at(rays, *hit, r);
        Vec3f d = random_direction(random);
        if (i % 2 == 0) {  // nearly along the surface
          d = d - (dot(d, s.geometric_normal) - 0.001f) * s.geometric_normal;
          d = normalized(d);
        }
        if (dot(d, s.geometric_normal) < 0) d = -d;
        shadowed += rays.occluded({leave_surface(s, d), 0, d, 4 * p.scale});
      }
      EXPECT_EQ(shadowed, 0);
      EXPECT_GT(met, 20'000);
    }
  }
}

// A sphere that rests on a plane: rays from the plane towards the sphere's lower half must meet it, down to the contact.
TEST(Offsets, NoLightBetweenASphereAndThePlaneItRestsOn) {
  const FlushDenormals flush;
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const float scale : {1e-3f, 1.0f, 1e4f}) {
    Mesh plane;
    plane.positions = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    Scene scene = scene_of(plane, {scaled(scale)});
    scene.spheres.push_back({{0, scale, 0}, scale, 0});
    const RayScene rays(scene);
    int open = 0, from_plane = 0;
    for (int i = 0; i < 100'000; ++i) {
      const float distance = scale * std::pow(10.0f, -5 * unit(random)), turn = 6.2831853f * unit(random);
      // The point of the plane, met from below so that the sphere is not in the way.
      const Vec3f on_plane{distance * std::cos(turn), 0, distance * std::sin(turn)};
      const Ray r{on_plane - Vec3f{0, scale, 0}, 0, {0, 1, 0}, 1e30f};
      const auto hit = rays.closest(r);
      ASSERT_TRUE(hit);
      if (hit->object != 0) continue;  // the sphere, where both are equally far in floats
      ++from_plane;
      const Surface s = surface_at(rays, *hit, r);
      open += !rays.occluded({leave_surface(s, {0, 1, 0}), 0, {0, 1, 0}, 1e30f});
    }
    EXPECT_EQ(open, 0) << "scale " << scale;
    EXPECT_GT(from_plane, 60'000);
  }
}

}  // namespace
}  // namespace welkin
