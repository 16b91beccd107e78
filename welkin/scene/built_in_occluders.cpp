#include <cmath>
#include <numbers>

#include <welkin/scene/built_in_scenes.h>
#include <welkin/scene/shapes.h>

// Scenes of many corners and thin things, for occlusion.

namespace welkin {
namespace {

int add_matte(Scene& scene, const char* name, Rgb color) {
  Material material;
  material.name = name;
  material.model = MaterialModel::lambert;
  material.base_color = color;
  return add_material(scene, material);
}

Camera look(const char* name, Vec3f eye, Vec3f target) {
  Camera camera;
  camera.name = name;
  camera.to_world = look_at(eye, target, {0, 1, 0});
  camera.vertical_field_radians = 0.7f;
  camera.width_over_height = 1.5f;
  return camera;
}

Affine placed(Vec3f origin) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, origin}; }

constexpr float rise = 0.17f, run = 0.28f, half_width = 1;

// Steps that climb towards -z, with a thin rail of one baluster a step on both sides.
void add_stairs(Scene& scene, int steps, float baluster, int stone, int iron) {
  const float half = baluster / 2;
  const int post = add_mesh(scene, make_box({-half, 0, -half}, {half, 0.8f, half}), iron);
  for (int i = 0; i < steps; ++i) {
    const float height = rise * static_cast<float>(i + 1), front = -run * static_cast<float>(i);
    const Mesh step = make_box({-half_width, 0, front - run}, {half_width, height, front});
    add_instance(scene, add_mesh(scene, step, stone));
    for (const float x : {-half_width + 0.06f, half_width - 0.06f})
      add_instance(scene, post, placed({x, height, front - run / 2}));
  }
}

// Quads of the plane's quasi-random points (Roberts 2018), turned anyhow, in an ellipsoid about the origin.
void add_leaves(Scene& scene, int count, float size, int material) {
  const Mesh leaf = make_rectangle({-0.5f * size, -0.3f * size, 0}, {size, 0, 0}, {0, 0.6f * size, 0});
  const int mesh = add_mesh(scene, leaf, material);
  const auto share = [](int i, double step) {
    const double x = 0.5 + step * i;
    return static_cast<float>(x - std::floor(x));
  };
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  for (int i = 0; i < count; ++i) {
    const float y = 2 * share(i, 0.8191725134) - 1, angle = turn * share(i, 0.6710436067);
    const float far = std::cbrt(share(i, 0.5497004779)), across = std::sqrt(1 - y * y);
    const Vec3f at{far * across * std::cos(angle), 0.75f * far * y, far * across * std::sin(angle)};
    const float tilt = turn * share(i, 0.4142135624), heading = turn * share(i, 0.7320508076);
    const Vec3f x{std::cos(heading), 0, -std::sin(heading)};
    const Vec3f up =
        std::cos(tilt) * Vec3f{0, 1, 0} + std::sin(tilt) * Vec3f{std::sin(heading), 0, std::cos(heading)};
    add_instance(scene, mesh, {x, up, cross(x, up), at + Vec3f{0, 1.25f, 0}});
  }
}

}  // namespace

Scene make_stairs_scene(SceneParameters& parameters) {
  const int steps = parameters.count("steps", 9, 1, 100);
  const float baluster = parameters.number("baluster", 0.025f, 1e-4f, 0.2f);
  Scene scene;
  const int stone = add_matte(scene, "stone", {0.6f, 0.58f, 0.54f});
  const int iron = add_matte(scene, "iron", {0.25f, 0.25f, 0.28f});
  const float back = -run * static_cast<float>(steps), height = rise * static_cast<float>(steps) + 2.2f;
  const int floor = add_mesh(scene, make_rectangle({-4, 0, 4}, {8, 0, 0}, {0, 0, back - 4}), stone);
  const int wall = add_mesh(scene, make_rectangle({-4, 0, back}, {8, 0, 0}, {0, height, 0}), stone);
  add_instance(scene, floor);
  add_instance(scene, wall);
  add_stairs(scene, steps, baluster, stone, iron);
  const Mesh shaft = make_lathe({{{0.16f, 0}, {1, 0}}, {{0.13f, height}, {1, 0}}}, 48);
  const int pillar = add_mesh(scene, shaft, stone);
  const int foot = add_mesh(scene, make_box({-0.24f, 0, -0.24f}, {0.24f, 0.2f, 0.24f}), stone);
  for (const float x : {-1.6f, 1.6f}) {
    for (const float z : {0.3f, back / 2, back + 0.4f}) {
      add_instance(scene, pillar, placed({x, 0, z}));
      add_instance(scene, foot, placed({x, 0, z}));
    }
  }
  scene.cameras.push_back(look("front", {-1.1f, 1.9f, 4.2f}, {0.1f, 0.95f, back / 2}));
  return scene;
}

Scene make_cards_scene(SceneParameters& parameters) {
  const int leaves = parameters.count("leaves", 700, 1, 100000);
  const float size = parameters.number("size", 0.16f, 1e-3f, 1);
  Scene scene;
  const int ground = add_matte(scene, "ground", {0.35f, 0.3f, 0.25f});
  const int leaf = add_matte(scene, "leaf", {0.2f, 0.42f, 0.12f});
  const int wood = add_matte(scene, "wood", {0.3f, 0.22f, 0.15f});
  add_instance(scene, add_mesh(scene, make_rectangle({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}), ground));
  add_leaves(scene, leaves, size, leaf);
  const int stem = add_mesh(scene, make_lathe({{{0.05f, 0}, {1, 0}}, {{0.03f, 1.2f}, {1, 0}}}, 24), wood);
  add_instance(scene, stem);
  const int blade = add_mesh(scene, make_rectangle({-0.012f, 0, 0}, {0.024f, 0, 0}, {0, 0.35f, 0}), leaf);
  for (int i = 0; i < 60; ++i) {
    const float angle = 2.399963f * static_cast<float>(i), far = 0.25f * std::sqrt(static_cast<float>(i) + 1);
    const float c = std::cos(3 * angle), s = std::sin(3 * angle);
    add_instance(
        scene, blade,
        {{c, 0, -s}, {0.2f * s, 1, 0.2f * c}, {s, 0, c}, {far * std::cos(angle), 0, far * std::sin(angle)}});
  }
  scene.cameras.push_back(look("front", {0, 1.7f, 4.0f}, {0, 0.85f, 0}));
  return scene;
}

}  // namespace welkin
