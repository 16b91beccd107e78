#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>

#include <welkin/image/srgb.h>
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
std::shared_ptr<const EnvironmentData> make_normals_light() {
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

const std::shared_ptr<const EnvironmentData>& normals_light() {
  static const std::shared_ptr<const EnvironmentData> light = make_normals_light();
  return light;
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

// One renderer for all that a test draws: its shaders are compiled once.
class SceneShading : public testing::Test {
 protected:
  Image drawn(const Scene& scene, const std::shared_ptr<const EnvironmentData>& light) {
    if (!renderer_) renderer_.emplace(exact);
    renderer_->set_technique(find_technique("irradiance-map"), {});
    renderer_->set_camera(scene.cameras[0]);
    renderer_->set_scene(scene);
    renderer_->set_environment(light);
    renderer_->resize(width, height);
    renderer_->show_background = false;
    renderer_->draw();
    return renderer_->read_picture();
  }
  void expect_same_normals(const Scene& scene, const std::string& what, double share_of_edges, double mean);

 private:
  HeadlessContext context_;
  std::optional<Renderer> renderer_;
};

struct NormalErrors {
  int compared = 0;
  int other_coverage = 0;  ///< pixels where one sees a surface and the other none
  int beyond = 0;          ///< pixels whose normals are more than 0.03 apart: edges
  double mean = 0;         ///< distance of the others' normals
};

NormalErrors normal_errors(const Scene& scene, const Image& picture) {
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

void SceneShading::expect_same_normals(const Scene& scene, const std::string& what, double share_of_edges,
                                       double mean) {
  Scene white = scene;
  make_white(white);
  const NormalErrors errors = normal_errors(white, drawn(white, normals_light()));
  EXPECT_GT(errors.compared, width * height / 10) << what;
  EXPECT_LE(errors.other_coverage, 0.01 * width * height) << what;
  EXPECT_LE(errors.beyond, share_of_edges * errors.compared) << what;
  EXPECT_LE(errors.mean, mean) << what;
}

// Bilinear look-ups with weights of 8 bits, and irradiance interpolated between texels 1.4 degrees apart.
constexpr double flat_error = 2e-3;

TEST_F(SceneShading, NormalMapsLeanAsThePathTracersWhereverTheMeshIsPlaced) {
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

TEST_F(SceneShading, OrthographicCamerasShowTheSameNormals) {
  Scene scene = bumpy_square({{1.2f, 0, 0.5f}, {0.3f, 0.8f, 0}, {0, 0.2f, 0.5f}, {}});
  scene.cameras[0].orthographic_height = 2.5f;
  expect_same_normals(scene, "leaning", 0.001, flat_error);
}

TEST_F(SceneShading, SpheresAreTexturedAsThePathTracers) {
  Scene scene = bumpy_square({});
  scene.instances.clear();
  scene.meshes.clear();
  scene.spheres = {{{0, 0, 0}, 1.1f, 0}};
  scene.textures[0].wrap_u = TextureWrap::repeat;
  expect_same_normals(scene, "sphere", 0.02, 4e-3);
}

// Normals against the winding count as the triangle's side says.
TEST_F(SceneShading, NormalsAreOnTheTrianglesSide) {
  Scene scene = bumpy_square({{0.9f, 0, 0.4f}, {0, 1, 0}, {-0.4f, 0, 0.9f}, {}});
  scene.meshes[0].normals.assign(4, {0, 0, -1});
  expect_same_normals(scene, "normals inwards", 0.001, flat_error);
}

// One half of the square lies behind the eye's plane, where parallel rays begin.
TEST_F(SceneShading, OrthographicCamerasSeeNothingBehindThem) {
  Scene scene = bumpy_square({{1, 0, 1}, {0, 1, 0}, {0, 0, 1}, {}});
  scene.cameras[0].to_world.origin = {0, 0, 0};
  scene.cameras[0].orthographic_height = 2.5f;
  expect_same_normals(scene, "half behind", 0.001, flat_error);
}

TEST_F(SceneShading, OneSidedLightsEmitFromTheFront) {
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

std::shared_ptr<const EnvironmentData> white_light() {
  Image white(16, 8);
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
  return oracle::small_environment(std::move(white));
}

// A square with a texture of colours that 8-bit sRGB has exactly (as files give them), or in between.
Scene textured_square(int size, bool eight_bit, const std::function<float(int, int, int)>& level) {
  Scene scene = bumpy_square({});
  Image image(size, size, 4);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < 4; ++c) {
        const double value = eight_bit ? std::round(255 * level(x, y, c)) / 255 : level(x, y, c);
        image.at(x, y)[c] = static_cast<float>(c < 3 ? srgb_to_linear(value) : value);
      }
  scene.textures = {{"colours", image, TextureWrap::repeat, TextureWrap::repeat, false}};
  Material& m = scene.materials[0];
  m = {};
  m.model = MaterialModel::lambert;
  m.base_color_texture.texture = 0;
  return scene;
}

float mixed_level(int x, int y, int c) {
  return c == 3
             ? 1.0f
             : 0.5f + 0.5f * std::sin(0.9f * static_cast<float>(x * (c + 1)) + 1.7f * static_cast<float>(y));
}

// Magnified: the same bilinear look-ups, with the texture turned, scaled and moved (KHR_texture_transform).
TEST_F(SceneShading, ColoursOfTexturesAreThePathTracers) {
  for (const bool eight_bit : {true, false}) {
    Scene scene = textured_square(8, eight_bit, mixed_level);
    TextureUse& use = scene.materials[0].base_color_texture;
    use.offset = {0.2f, -0.3f};
    use.scale = {0.9f, 1.3f};
    use.rotation_radians = 0.5f;
    const Image picture = drawn(scene, white_light());
    const RenderScene traced(scene, nullptr);
    double largest = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto point = oracle::point_at_pixel(traced, scene.cameras[0], {width, height}, x, y);
        const bool both = point && picture.at(x, y)[3] == 1;
        for (int c = 0; c < 3 && both; ++c) {
          const float wanted = c == 0   ? point->scatter->color.r
                               : c == 1 ? point->scatter->color.g
                                        : point->scatter->color.b;
          largest = std::max(largest, std::abs(double{picture.at(x, y)[c]} - wanted));
        }
      }
    EXPECT_GT(picture.at(width / 2, height / 2)[0], 0);
    // Weights of bilinear look-ups have 8 bits, of both axes; E and half floats are off by 1e-3.
    EXPECT_LT(largest, 0.012) << eight_bit;
  }
}

// A chequer finer than pixels is half its white, in linear light: averaged as sRGB codes it would be a fifth.
TEST_F(SceneShading, FineTexturesAreAveragedInLinearLight) {
  for (const bool eight_bit : {true, false}) {
    const float white = eight_bit ? 1.0f : 0.9999f;
    Scene scene = textured_square(
        256, eight_bit, [&](int x, int y, int c) { return c == 3 || ((x + y) & 1) != 0 ? white : 0.0f; });
    const Image picture = drawn(scene, white_light());
    EXPECT_NEAR(picture.at(width / 2, height / 2)[1], 0.5, 5e-3) << eight_bit;
    EXPECT_NEAR(picture.at(width / 2 + 5, height / 2 - 7)[1], 0.5, 5e-3) << eight_bit;
  }
}

// Texels of a mask are kept where their coverage is not below the cutoff, as the path tracer keeps them.
TEST_F(SceneShading, MasksCutOutWhatThePathTracerCutsOut) {
  Scene scene = textured_square(8, true, [](int x, int y, int c) {
    return c == 3 ? static_cast<float>((3 * x + 5 * y) % 8) / 7.0f : 0.5f;
  });
  scene.textures[0].nearest = true;
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.materials[0].alpha_cutoff = 0.35f;
  const Image picture = drawn(scene, white_light());
  const RenderScene traced(scene, nullptr);
  int kept = 0, cut = 0, other = 0;
  for (int y = 9; y < height - 9; ++y)
    for (int x = 18; x < width - 18; ++x) {
      const bool here = picture.at(x, y)[3] == 1;
      const bool there = oracle::point_at_pixel(traced, scene.cameras[0], {width, height}, x, y) != nullptr;
      ++(here ? kept : cut);
      other += here != there;
    }
  EXPECT_GT(kept, 300);
  EXPECT_GT(cut, 300);
  EXPECT_LE(other, 20);  // at the edges of texels
}

TEST_F(SceneShading, BuiltInScenesHaveThePathTracersNormals) {
  for (const BuiltInScene& built_in : built_in_scenes()) {
    if (built_in.name == "bumpy")
      continue;  // its map is finer than these pixels: the means of its mips are the bump techniques' matter
    expect_same_normals(make_built_in_scene(built_in.name), std::string(built_in.name), 0.05, 4e-3);
  }
}

}  // namespace
}  // namespace welkin
