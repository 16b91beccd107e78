#include <cmath>
#include <numbers>

#include <welkin/scene/built_in_scenes.h>
#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

Material matte(const char* name, Rgb color) {
  Material material;
  material.name = name;
  material.model = MaterialModel::lambert;
  material.base_color = color;
  return material;
}

Affine turned_about_y(float radians, Vec3f origin) {
  const float c = std::cos(radians), s = std::sin(radians);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, origin};
}

Camera perspective(const char* name, Vec3f eye, Vec3f target, float field_radians, float width_over_height) {
  Camera camera;
  camera.name = name;
  camera.to_world = look_at(eye, target, {0, 1, 0});
  camera.vertical_field_radians = field_radians;
  camera.width_over_height = width_over_height;
  return camera;
}

void add_rectangle(Scene& scene, Vec3f corner, Vec3f across, Vec3f up, int material) {
  add_instance(scene, add_mesh(scene, make_rectangle(corner, across, up), material));
}

// Walls face inwards; the front is open.
void add_walls(Scene& scene, int white, int red, int green) {
  add_rectangle(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, white);  // floor
  add_rectangle(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white);  // ceiling
  add_rectangle(scene, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white);  // back
  add_rectangle(scene, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, red);    // left
  add_rectangle(scene, {1, 0, -1}, {0, 0, 2}, {0, 2, 0}, green);   // right
}

Texture chequer_texture() {
  constexpr int squares = 16;
  Texture texture{"chequer", Image(squares, squares, 1)};
  texture.nearest = true;
  for (int i = 0; i < squares * squares; ++i)
    texture.image.pixels[i] = (i / squares + i) % 2 == 0 ? 0.35f : 0.18f;
  Image& image = texture.image;
  std::vector<float> rgb;
  for (float value : image.pixels) rgb.insert(rgb.end(), 3, value);
  image.channels = 3, image.pixels = std::move(rgb);
  return texture;
}

// A foot with rounded rims, from its bottom's middle to its top's.
Mesh make_pedestal() {
  std::vector<OutlinePoint> outline{{{0, 0}, {0, -1}}, {{0.9f, 0}, {0, -1}}};
  const auto add_round = [&outline](Vec2f centre, float radius, double from, double to) {
    for (int i = 0; i <= 8; ++i) {
      const double angle = from + (to - from) * i / 8;
      const Vec2f normal{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
      outline.push_back({centre + radius * normal, normal});
    }
  };
  constexpr double right = std::numbers::pi / 2;
  add_round({0.9f, 0.06f}, 0.06f, -right, right);
  outline.push_back({{0.62f, 0.12f}, {0, 1}});
  outline.push_back({{0.62f, 0.12f}, {1, 0}});
  add_round({0.57f, 0.3f}, 0.05f, 0, right);
  outline.push_back({{0, 0.35f}, {0, 1}});
  Mesh mesh = make_lathe(outline, 96);
  mesh.name = "pedestal";
  return mesh;
}

}  // namespace

Scene make_box_scene(SceneParameters& parameters) {
  const float radiance = parameters.number("radiance", 17, 0, 1e6f);
  Scene scene;
  const int white = add_material(scene, matte("white", {0.73f, 0.73f, 0.73f}));
  const int red = add_material(scene, matte("red", {0.63f, 0.06f, 0.05f}));
  const int green = add_material(scene, matte("green", {0.14f, 0.45f, 0.09f}));
  Material lamp = matte("light", {0, 0, 0});
  lamp.emission = radiance * Rgb{1, 0.75f, 0.45f};
  const int light = add_material(scene, lamp);
  add_walls(scene, white, red, green);
  add_rectangle(scene, {-0.25f, 1.995f, 0.1f}, {0.5f, 0, 0}, {0, 0, 0.5f}, light);  // faces down
  const int tall = add_mesh(scene, make_box({-0.3f, 0, -0.3f}, {0.3f, 1.2f, 0.3f}), white);
  const int low = add_mesh(scene, make_box({-0.3f, 0, -0.3f}, {0.3f, 0.6f, 0.3f}), white);
  add_instance(scene, tall, turned_about_y(0.3f, {-0.35f, 0, -0.45f}));
  add_instance(scene, low, turned_about_y(-0.3f, {0.38f, 0, 0.0f}));
  scene.cameras.push_back(perspective("front", {0, 1, 4.05f}, {0, 1, 0}, 0.66f, 1));
  return scene;
}

Scene make_shader_ball_scene(SceneParameters& parameters) {
  Material ball;
  ball.name = "ball";
  ball.base_color = {0.85f, 0.35f, 0.12f};
  ball.metallic = parameters.number("metallic", 0, 0, 1);
  ball.perceptual_roughness = parameters.number("roughness", 0.3f, 0, 1);
  ball.anisotropy = parameters.number("anisotropy", 0, -0.99f, 0.99f);
  Material foot = ball, ground = matte("ground", {1, 1, 1});
  foot.name = "foot";
  foot.base_color = {0.06f, 0.06f, 0.06f}, foot.metallic = 0, foot.perceptual_roughness = 0.45f,
  foot.anisotropy = 0;
  Scene scene;
  scene.textures.push_back(chequer_texture());
  ground.base_color_texture.texture = 0;
  ground.base_color_texture.scale = {2, 2};
  add_rectangle(scene, {-6, 0, 6}, {12, 0, 0}, {0, 0, -12}, add_material(scene, ground));
  add_instance(scene, add_mesh(scene, make_pedestal(), add_material(scene, foot)));
  const int material = add_material(scene, ball);
  scene.spheres.push_back({{0, 1.2f, 0}, 0.85f, material});
  const Mesh ring = make_torus(1.02f, 0.07f, 192, 48);
  add_instance(scene, add_mesh(scene, ring, material),
               {{0.94f, 0.34f, 0}, {-0.34f, 0.94f, 0}, {0, 0, 1}, {0, 1.2f, 0}});
  scene.cameras.push_back(perspective("front", {0, 2.6f, 5.2f}, {0, 1.0f, 0}, 0.5f, 1.25f));
  return scene;
}

Scene make_fences_scene(SceneParameters& parameters) {
  const int rows = parameters.count("rows", 6, 1, 200), posts = parameters.count("posts", 24, 2, 2000);
  const float thickness = parameters.number("thickness", 0.02f, 1e-5f, 0.1f), half = thickness / 2;
  constexpr float step = 0.25f, between = 0.9f;
  const float width = step * static_cast<float>(posts - 1), depth = between * static_cast<float>(rows - 1);
  Scene scene;
  const int ground = add_material(scene, matte("ground", {0.35f, 0.4f, 0.25f}));
  const int wood = add_material(scene, matte("wood", {0.6f, 0.42f, 0.25f}));
  const float reach = 3 * (width + depth) + 10;
  add_rectangle(scene, {-reach, 0, reach}, {2 * reach, 0, 0}, {0, 0, -2 * reach}, ground);
  const int post = add_mesh(scene, make_box({-0.04f, 0, -half}, {0.04f, 0.9f, half}), wood);
  const int rail = add_mesh(scene, make_box({-width / 2, -0.03f, -half}, {width / 2, 0.03f, half}), wood);
  for (int row = 0; row < rows; ++row) {
    const float z = depth / 2 - between * static_cast<float>(row);
    for (const float y : {0.25f, 0.7f})
      add_instance(scene, rail, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, y, z - thickness}});
    for (int i = 0; i < posts; ++i)
      add_instance(scene, post,
                   {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {step * static_cast<float>(i) - width / 2, 0, z}});
  }
  const float distance = depth / 2 + 0.9f * width + 1;
  scene.cameras.push_back(
      perspective("side", {-0.35f * width, 0.25f * distance + 1, distance}, {0, 0.3f, 0}, 0.6f, 1.5f));
  return scene;
}

}  // namespace welkin
