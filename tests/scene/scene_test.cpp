#include <welkin/scene/scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <welkin/error.h>
#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

Scene small_scene() {
  Scene scene;
  scene.source = "small";
  scene.textures.push_back({"chequer", Image(2, 2, 3)});
  add_material(scene, {});
  scene.materials[0].base_color_texture.texture = 0;
  add_instance(scene, add_mesh(scene, make_rectangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), 0));
  scene.spheres.push_back({{0, 0, -4}, 0.5f, 0});
  scene.lights.emplace_back();
  scene.cameras.emplace_back();
  return scene;
}

TEST(CheckScene, AcceptsASmallScene) { EXPECT_NO_THROW(check_scene(small_scene())); }
TEST(CheckScene, AcceptsAnEmptyScene) { EXPECT_NO_THROW(check_scene({})); }

struct Fault {
  const char* message;
  std::function<void(Scene&)> damage;
};

const std::vector<Fault> faults = {
    {"small: texture 0 \"chequer\": has no pixels", [](Scene& s) { s.textures[0].image.width = 0; }},
    {"small: texture 0 \"chequer\": its pixels do not fill its size",
     [](Scene& s) { s.textures[0].image.pixels.pop_back(); }},
    {"small: texture 0 \"chequer\": a pixel is not finite",
     [](Scene& s) { s.textures[0].image.pixels[3] = INFINITY; }},
    {"small: material 0: uses a texture that the scene does not have",
     [](Scene& s) { s.materials[0].normal_texture.texture = 1; }},
    {"small: material 0: uses a channel that its texture does not have",
     [](Scene& s) { s.materials[0].metallic_texture = {.texture = 0, .channel = 3}; }},
    {"small: material 0: its perceptual roughness is not in [0, 1]",
     [](Scene& s) { s.materials[0].perceptual_roughness = NAN; }},
    {"small: material 0: its emission is negative or not finite",
     [](Scene& s) { s.materials[0].emission.g = -1; }},
    {"small: mesh 0 \"rectangle\": uses a material that the scene does not have",
     [](Scene& s) { s.meshes[0].material = 1; }},
    {"small: mesh 0 \"rectangle\": has 3 normals for 4 positions",
     [](Scene& s) { s.meshes[0].normals.pop_back(); }},
    {"small: mesh 0 \"rectangle\": a value of its positions is not finite",
     [](Scene& s) { s.meshes[0].positions[1].y = NAN; }},
    {"small: mesh 0 \"rectangle\": a triangle uses vertex 4 of 4",
     [](Scene& s) { s.meshes[0].triangles[1][2] = 4; }},
    {"small: mesh 0 \"rectangle\": has tangents without signs or signs alone",
     [](Scene& s) { s.meshes[0].tangent_signs.clear(); }},
    {"small: instance 0: uses a mesh that the scene does not have",
     [](Scene& s) { s.instances[0].mesh = -1; }},
    {"small: instance 0: its transform flattens it", [](Scene& s) { s.instances[0].to_world.x = {}; }},
    {"small: instance 0: its transform is not finite",
     [](Scene& s) { s.instances[0].to_world.origin.z = NAN; }},
    {"small: sphere 0: its radius is not above 0", [](Scene& s) { s.spheres[0].radius = 0; }},
    {"small: light 0: its direction is not of unit length", [](Scene& s) { s.lights[0].direction = {}; }},
    {"small: light 0: its cones are not 0 <= inner <= outer <= pi / 2",
     [](Scene& s) { s.lights[0].inner_cone_radians = 1; }},
    {"small: camera 0: its field of view is not in (0, pi)",
     [](Scene& s) { s.cameras[0].vertical_field_radians = 4; }},
    {"small: camera 0: its frame is not orthonormal",
     [](Scene& s) {
       s.cameras[0].to_world.x = {2, 0, 0};
     }},
    {"small: the scene reaches further than 1e12 metres", [](Scene& s) { s.spheres[0].centre.x = 2e12f; }},
};

TEST(CheckScene, NamesTheFirstFault) {
  for (const Fault& fault : faults) {
    Scene scene = small_scene();
    fault.damage(scene);
    std::string message = "no error";
    try {
      check_scene(scene);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, fault.message);
  }
}

TEST(SceneBounds, HoldsMeshesAndSpheres) {
  const std::optional<Bounds> bounds = scene_bounds(small_scene());
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->low, (Vec3f{-0.5f, -0.5f, -4.5f}));
  EXPECT_EQ(bounds->high, (Vec3f{2, 3, 0}));
}

// Turned by 45 degrees, a diamond's corners lie on the axes: its own box would reach sqrt(2) further.
TEST(SceneBounds, OfOneRotatedInstanceAreExact) {
  const float h = std::sqrt(0.5f);
  Scene scene;
  add_material(scene, {});
  const int mesh = add_mesh(scene, make_rectangle({-h, 0, 0}, {h, -h, 0}, {h, h, 0}), 0);
  add_instance(scene, mesh, {{h, h, 0}, {-h, h, 0}, {0, 0, 1}, {10, 0, 0}});
  EXPECT_NEAR(scene_bounds(scene)->low.x, 9.5f, 1e-5f);  // rounding
  EXPECT_NEAR(scene_bounds(scene)->high.x, 10.5f, 1e-5f);
  add_instance(scene, mesh, {{h, h, 0}, {-h, h, 0}, {0, 0, 1}, {20, 0, 0}});
  EXPECT_LE(scene_bounds(scene)->low.x, 9.5f + 1e-5f);  // may be larger, never smaller
  EXPECT_GE(scene_bounds(scene)->high.x, 20.5f - 1e-5f);
}

TEST(SceneBounds, NothingWithoutGeometry) {
  Scene scene;
  EXPECT_FALSE(scene_bounds(scene));
  add_material(scene, {});
  add_instance(scene, add_mesh(scene, {}, 0));
  EXPECT_FALSE(scene_bounds(scene));
}

// How far out the corners of a box come, in halves of the picture: 1 is its edge.
float farthest_in_picture(const Bounds& b, const Camera& camera, double width_over_height) {
  const float t = std::tan(camera.vertical_field_radians / 2);
  float farthest = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3f corner{(i & 1) != 0 ? b.high.x : b.low.x, (i & 2) != 0 ? b.high.y : b.low.y,
                       (i & 4) != 0 ? b.high.z : b.low.z};
    const Vec3f p = inverse(camera.to_world).point(corner);
    EXPECT_LT(p.z, 0);
    farthest = std::max({farthest, std::fabs(p.y) / (-p.z * t),
                         std::fabs(p.x) / (-p.z * t * static_cast<float>(width_over_height))});
  }
  return farthest;
}

TEST(DefaultCamera, FillsThePicture) {
  for (const double aspect : {0.3, 1.0, 4.0}) {
    const Bounds bounds{{-1, 2, 3}, {5, 2.5f, 30}};
    const Camera camera = default_camera(bounds, aspect);
    // A margin of 5 %.
    EXPECT_NEAR(farthest_in_picture(bounds, camera, aspect), 1 / 1.05f, 1e-4f);
  }
}

TEST(DefaultCamera, TakesAPoint) {
  Scene scene;
  scene.cameras.push_back(default_camera({{1, 1, 1}, {1, 1, 1}}, 1));
  EXPECT_NO_THROW(check_scene(scene));
}

}  // namespace
}  // namespace welkin
