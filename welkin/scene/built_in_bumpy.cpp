#include <cmath>
#include <numbers>

#include <welkin/scene/built_in_scenes.h>
#include <welkin/scene/bump_textures.h>
#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

Camera camera_above(Vec3f eye, Vec3f target, float field_radians, float width_over_height) {
  Camera camera;
  camera.name = "above";
  camera.to_world = look_at(eye, target, {0, 1, 0});
  camera.vertical_field_radians = field_radians;
  camera.width_over_height = width_over_height;
  return camera;
}

// A ball of radius 1 as a mesh, so that every renderer has the same tangents.
Mesh make_ball() {
  constexpr int rows = 128, columns = 256;
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= rows; ++i) {
    const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / rows - 0.5f);
    const Vec2f point{i == 0 || i == rows ? 0 : std::cos(angle), std::sin(angle)};
    outline.push_back({point, point});
  }
  return make_lathe(outline, columns);
}

Material bumpy_material(SceneParameters& parameters) {
  const float alpha = parameters.number("alpha", 0.1f, 0, 1);
  Material glossy;
  glossy.name = "bumpy";
  if (alpha == 0) glossy.model = MaterialModel::mirror;
  glossy.base_color = {0.9f, 0.72f, 0.4f};
  glossy.perceptual_roughness = std::sqrt(alpha);
  glossy.normal_texture.texture = 0;
  return glossy;
}

}  // namespace

Scene make_bumpy_scene(SceneParameters& parameters) {
  constexpr std::string_view shapes[] = {"plane", "ball"};
  const bool ball = parameters.choice("shape", shapes) == 1;
  Scene scene;
  const auto pattern = static_cast<BumpPattern>(parameters.choice("pattern", bump_pattern_names()));
  scene.textures.push_back(make_bump_texture(pattern, parameters.count("bumps", 4, 1, 64),
                                             parameters.number("slope", 0.5f, 0, 4)));
  Material material = bumpy_material(parameters);
  const float tiling = parameters.number("tiling", 1, 1e-3f, 1e3f);
  material.normal_texture.scale = {ball ? 2 * tiling : tiling, tiling};
  const int index = add_material(scene, material);
  if (ball) {
    add_instance(scene, add_mesh(scene, make_ball(), index));
    scene.cameras.push_back(camera_above({0, 1.2f, 5}, {0, 0, 0}, 0.45f, 1));
  } else {
    add_instance(scene, add_mesh(scene, make_rectangle({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), index));
    scene.cameras.push_back(camera_above({0, 2.2f, 4.2f}, {0, 0, 0.1f}, 0.62f, 1.5f));
  }
  return scene;
}

}  // namespace welkin
