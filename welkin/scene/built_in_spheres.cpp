#include <fmt/format.h>

#include <cmath>

#include <welkin/scene/built_in_scenes.h>
#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

// Columns and rows of unit spheres, `spacing` apart, in the plane z = 0, the first one at the top left.
constexpr float spacing = 2.4f;

Vec3f grid_point(int column, int row, int columns, int rows) {
  return {spacing * (static_cast<float>(column) - 0.5f * static_cast<float>(columns - 1)),
          spacing * (0.5f * static_cast<float>(rows - 1) - static_cast<float>(row)), 0};
}

// Orthographic, so that every column has the same share of the picture's width and all spheres the same view.
Camera grid_camera(int columns, int rows) {
  Camera camera;
  camera.name = "front";
  camera.to_world.origin = {0, 0, 10};
  camera.orthographic_height = spacing * static_cast<float>(rows);
  camera.width_over_height = static_cast<float>(columns) / static_cast<float>(rows);
  return camera;
}

Material glossy(MaterialModel model, float alpha) {
  Material material;
  material.model = model;
  material.perceptual_roughness = std::sqrt(alpha);
  return material;
}

Material metal(float alpha) {
  Material material = glossy(alpha > 0 ? MaterialModel::ggx : MaterialModel::mirror, alpha);
  material.name = alpha > 0 ? fmt::format("metal {:.3g}", alpha) : "metal mirror";
  material.base_color = {0.95f, 0.93f, 0.88f};  // silver
  return material;
}

Material plastic(float alpha) {
  Material material = glossy(MaterialModel::coated_diffuse, alpha);
  material.name = alpha > 0 ? fmt::format("plastic {:.3g}", alpha) : "plastic smooth";
  material.base_color = {0.55f, 0.08f, 0.05f};
  return material;
}

std::vector<Material> lossless_materials(float alpha) {
  const auto named = [alpha](MaterialModel model, const char* name) {
    Material material = glossy(model, alpha);
    material.name = name;
    return material;
  };
  std::vector<Material> materials{
      named(MaterialModel::lambert, "lambert"),
      named(MaterialModel::oren_nayar, "oren-nayar"),
      named(MaterialModel::phong, "phong"),
      named(MaterialModel::blinn_phong, "blinn-phong"),
      named(MaterialModel::lafortune, "lafortune"),
      named(MaterialModel::ggx, "ggx"),
      named(MaterialModel::ggx, "ggx anisotropic"),
      named(MaterialModel::ggx_conductor, "ggx-conductor"),
      named(MaterialModel::mirror, "mirror"),
      named(MaterialModel::conductor, "conductor"),
      named(MaterialModel::coated_diffuse, "coated-diffuse"),
      named(MaterialModel::metallic_roughness, "metallic-roughness"),
  };
  materials[1].sigma_radians = 0.5f;
  materials[6].anisotropy = 0.6f;
  // A metal whose index has no real part reflects everything at every angle.
  for (int conductor : {7, 9}) materials[conductor].eta = {0, 0, 0}, materials[conductor].k = {3, 3, 3};
  return materials;
}

}  // namespace

Scene make_spheres_scene(SceneParameters& parameters) {
  const std::vector<float> alphas = parameters.list("alphas", {0, 0.03f, 0.1f, 0.2f, 0.4f, 0.7f, 1}, 0, 1);
  const int columns = static_cast<int>(alphas.size());
  Scene scene;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int material = add_material(scene, row == 0 ? metal(alphas[column]) : plastic(alphas[column]));
      scene.spheres.push_back({grid_point(column, row, columns, 2), 1, material});
    }
  }
  scene.cameras.push_back(grid_camera(columns, 2));
  return scene;
}

Scene make_furnace_scene(SceneParameters& parameters) {
  Scene scene;
  scene.materials = lossless_materials(parameters.number("alpha", 0.25f, 1e-3f, 1));
  for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i)
    scene.spheres.push_back({grid_point(i % 4, i / 4, 4, 3), 1, i});
  scene.cameras.push_back(grid_camera(4, 3));
  return scene;
}

Scene make_plane_scene(SceneParameters& parameters) {
  const float radius = parameters.number("radius", 1, 0.01f, 10), reach = 1000 * radius;
  Scene scene;
  Material ground, ball;
  ground.name = "plane", ball.name = "sphere";
  ground.model = ball.model = MaterialModel::lambert;
  ground.base_color = {0.5f, 0.5f, 0.5f};
  ball.base_color = {0.7f, 0.7f, 0.7f};
  const Mesh rectangle = make_rectangle({-reach, 0, reach}, {2 * reach, 0, 0}, {0, 0, -2 * reach});
  add_instance(scene, add_mesh(scene, rectangle, add_material(scene, ground)));
  scene.spheres.push_back({{0, radius, 0}, radius, add_material(scene, ball)});
  Camera camera;
  camera.name = "above";
  camera.to_world = look_at(radius * Vec3f{0, 3, 8}, radius * Vec3f{0, 0.75f, 0}, {0, 1, 0});
  camera.vertical_field_radians = 0.6f;
  camera.width_over_height = 1.5f;
  scene.cameras.push_back(camera);
  return scene;
}

}  // namespace welkin
