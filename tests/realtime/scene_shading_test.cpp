#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/shapes.h>
#include <welkin/sphere/cube.h>

#include "tests/realtime/shading_truth.h"

// What the renderer's shaders make of a scene, before any light: shading normals, sides, colours, against the path tracer at the centres
// of pixels. A picture shows them through irradiance-map in environments that say which normal they were asked for.

namespace welkin {
namespace {

constexpr int width = 72, height = 54;
constexpr RendererOptions exact{TexelFormat::rgba32f, TexelFormat::rgba32f};

// Irradiance pi (1 + n) / 2: under it white diffuse surfaces show (1 + n) / 2.
std::shared_ptr<const EnvironmentData> normals_light() {
  Image white(16, 8);
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
  auto data = std::make_shared<EnvironmentData>(*oracle::small_environment(std::move(white)));
  Cube& e = data->maps.irradiance;
  e = Cube(64);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < e.size; ++y)
      for (int x = 0; x < e.size; ++x) {
        const Vec3 d = cube_texel_direction(e.size, face, x, y);
        const double n[3] = {d.x, d.y, d.z};
        for (int c = 0; c < 3; ++c)
          e.at(face, x, y)[c] = static_cast<float>(std::numbers::pi * (1 + n[c]) / 2);
      }
  return data;
}

void make_white(Scene& scene) {
  for (Material& m : scene.materials) {
    m.model = MaterialModel::lambert;
    m.base_color = {1, 1, 1};
    m.base_color_texture = {};
    m.emission = {};
    m.alpha_mode = AlphaMode::opaque;
  }
}

Image drawn(const Scene& scene, const std::shared_ptr<const EnvironmentData>& light) {
  Renderer renderer(exact);
  renderer.set_technique(find_technique("irradiance-map"), {});
  renderer.set_camera(scene.cameras[0]);
  renderer.set_scene(scene);
  renderer.set_environment(light);
  renderer.resize(width, height);
  renderer.show_background = false;
  renderer.draw();
  return renderer.read_picture();
}

struct NormalErrors {
  int compared = 0;
  int other_coverage = 0;  ///< pixels where one sees a surface and the other none
  int beyond = 0;          ///< pixels whose normals are more than 0.03 apart: edges
  double mean = 0;         ///< distance of the others' normals
};

NormalErrors normal_errors(Scene scene) {
  make_white(scene);
  const Image picture = drawn(scene, normals_light());
  const RenderScene traced(scene, nullptr);
  NormalErrors errors;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* pixel = picture.at(x, y);
      const auto point = oracle::point_at_pixel(traced, scene.cameras[0], {width, height}, x, y);
      errors.other_coverage += (point != nullptr) != (pixel[3] == 1);
      if (!point || pixel[3] != 1) continue;
      ++errors.compared;
      const Vec3f n{2 * pixel[0] - 1, 2 * pixel[1] - 1, 2 * pixel[2] - 1};
      const float distance = length(n - point->frame.normal);
      errors.beyond += distance > 0.03f;
      errors.mean += distance > 0.03f ? 0 : distance;
    }
  errors.mean /= std::max(1, errors.compared - errors.beyond);
  return errors;
}

// A bumpy square that faces the camera, placed by `to_world`.
Scene bumpy_square(const Affine& to_world) {
  Scene scene;
  scene.source = "a bumpy square";
  Image bumps(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Vec3f n =
          normalized(Vec3f{0.1f + 0.06f * static_cast<float>(x), 0.05f * static_cast<float>(y) - 0.3f, 1});
      const float texel[3] = {0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z};
      std::copy_n(texel, 3, bumps.at(x, y));
    }
  scene.textures.push_back({"bumps", bumps, TextureWrap::clamp, TextureWrap::clamp, false});
  Material material;
  material.normal_texture.texture = 0;
  scene.materials.push_back(material);
  Mesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.normals.assign(4, {0, 0, 1});
  square.tangents.assign(4, {1, 0, 0});
  square.tangent_signs.assign(4, 1.0f);
  square.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(square);
  scene.instances.push_back({0, to_world});
  Camera camera;
  camera.to_world.origin = {0, 0, 4};
  camera.vertical_field_radians = 0.6f;
  scene.cameras.push_back(camera);
  return scene;
}

void expect_same_normals(const Scene& scene, const std::string& what, double share_of_edges, double mean) {
  const NormalErrors errors = normal_errors(scene);
  EXPECT_GT(errors.compared, width * height / 10) << what;
  EXPECT_LE(errors.other_coverage, 0.01 * width * height) << what;
  EXPECT_LE(errors.beyond, share_of_edges * errors.compared) << what;
  EXPECT_LE(errors.mean, mean) << what;
}

// Bilinear look-ups with weights of 8 bits, and irradiance interpolated between texels 1.4 degrees apart.
constexpr double flat_error = 2e-3;

TEST(SceneShading, NormalMapsLeanAsThePathTracersWhereverTheMeshIsPlaced) {
  const HeadlessContext context;
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const std::pair<const char*, Affine> places[] = {
      {"as it is", {}},
      {"mirrored in x", {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}},
      {"mirrored in y", {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {}}},
      {"mirrored in z: seen from behind", {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {}}},
      {"turned about: seen from behind", {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {}}},
      {"turned", {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}}},
      {"turned and mirrored", {{-c, 0, s}, {0, 1, 0}, {s, 0, c}, {}}},
      {"stretched and leaning", {{1.2f, 0, 0.5f}, {0.3f, 0.8f, 0}, {0, 0.2f, 0.5f}, {}}},
  };
  for (const auto& [name, place] : places) expect_same_normals(bumpy_square(place), name, 0.001, flat_error);
}

TEST(SceneShading, OrthographicCamerasShowTheSameNormals) {
  const HeadlessContext context;
  Scene scene = bumpy_square({{1.2f, 0, 0.5f}, {0.3f, 0.8f, 0}, {0, 0.2f, 0.5f}, {}});
  scene.cameras[0].orthographic_height = 2.5f;
  expect_same_normals(scene, "leaning", 0.001, flat_error);
}

TEST(SceneShading, SpheresAreTexturedAsThePathTracers) {
  const HeadlessContext context;
  Scene scene = bumpy_square({});
  scene.instances.clear();
  scene.meshes.clear();
  scene.spheres = {{{0, 0, 0}, 1.1f, 0}};
  scene.textures[0].wrap_u = TextureWrap::repeat;
  expect_same_normals(scene, "sphere", 0.02, 4e-3);
}

// Normals against the winding count as the triangle's side says.
TEST(SceneShading, NormalsAreOnTheTrianglesSide) {
  const HeadlessContext context;
  Scene scene = bumpy_square({{0.9f, 0, 0.4f}, {0, 1, 0}, {-0.4f, 0, 0.9f}, {}});
  scene.meshes[0].normals.assign(4, {0, 0, -1});
  expect_same_normals(scene, "normals inwards", 0.001, flat_error);
}

// One half of the square lies behind the eye's plane, where parallel rays begin.
TEST(SceneShading, OrthographicCamerasSeeNothingBehindThem) {
  const HeadlessContext context;
  Scene scene = bumpy_square({{1, 0, 1}, {0, 1, 0}, {0, 0, 1}, {}});
  scene.cameras[0].to_world.origin = {0, 0, 0};
  scene.cameras[0].orthographic_height = 2.5f;
  expect_same_normals(scene, "half behind", 0.001, flat_error);
}

TEST(SceneShading, OneSidedLightsEmitFromTheFront) {
  const HeadlessContext context;
  Scene scene = bumpy_square({{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {}});  // from behind
  Material& light = scene.materials[0];
  light.base_color = {0, 0, 0};
  light.emission = {1, 2, 3};
  const auto middle = [&](const Scene& shown) {
    return drawn(shown, normals_light()).at(width / 2, height / 2)[1];
  };
  EXPECT_EQ(middle(scene), 0);
  light.double_sided = true;
  EXPECT_EQ(middle(scene), 2);
  light.double_sided = false;
  scene.instances[0].to_world = {};
  EXPECT_EQ(middle(scene), 2);
}

TEST(SceneShading, BuiltInScenesHaveThePathTracersNormals) {
  const HeadlessContext context;
  for (const BuiltInScene& built_in : built_in_scenes()) {
    if (built_in.name == "bumpy")
      continue;  // its map is finer than these pixels: the means of its mips are the bump techniques' matter
    expect_same_normals(make_built_in_scene(built_in.name), std::string(built_in.name), 0.05, 4e-3);
  }
}

}  // namespace
}  // namespace welkin
