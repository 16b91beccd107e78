#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "commands.h"
#include "flat_file.h"

#include <welkin/image/output_file.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/gltf_write.h>
#include <welkin/scene/read_scene.h>

// welkin scene: what a scene holds.

namespace welkin {
namespace {

struct SceneCommand {
  std::string input, output;
};

std::string_view model_name(MaterialModel model) {
  constexpr std::string_view names[] = {
      "metallic-roughness", "lambert", "oren-nayar", "phong",      "blinn-phong",   "lafortune", "ggx",
      "ggx-conductor",      "mirror",  "conductor",  "dielectric", "coated-diffuse"};
  return names[static_cast<std::size_t>(model)];
}

std::string vector_text(Vec3f v) { return fmt::format("{:.5g} {:.5g} {:.5g}", v.x, v.y, v.z); }
std::string color_text(Rgb c) { return fmt::format("{:.4g} {:.4g} {:.4g}", c.r, c.g, c.b); }

std::string material_text(const Material& m) {
  std::string text = fmt::format("{}, color {}", model_name(m.model), color_text(m.base_color));
  if (m.model == MaterialModel::metallic_roughness)
    text += fmt::format(", metallic {:.3g}, perceptual roughness {:.3g}", m.metallic, m.perceptual_roughness);
  if (!is_black(m.emission)) text += ", emission " + color_text(m.emission);
  if (m.alpha_mode != AlphaMode::opaque)
    text += m.alpha_mode == AlphaMode::mask ? ", cut out" : fmt::format(", alpha {:.3g}", m.base_alpha);
  if (m.double_sided) text += ", double-sided";
  int textures = 0;
  for (const TextureUse* use :
       {&m.base_color_texture, &m.metallic_texture, &m.normal_texture, &m.emission_texture})
    textures += use->texture >= 0 ? 1 : 0;
  return textures > 0 ? text + fmt::format(", {} textures", textures) : text;
}

void print_counts(const Scene& scene) {
  std::size_t vertices = 0, triangles = 0, placed = 0;
  for (const Mesh& mesh : scene.meshes) vertices += mesh.positions.size(), triangles += mesh.triangles.size();
  for (const Instance& instance : scene.instances) placed += scene.meshes[instance.mesh].triangles.size();
  fmt::print("  meshes      {}, {} vertices, {} triangles\n", scene.meshes.size(), vertices, triangles);
  fmt::print("  instances   {}, {} triangles\n", scene.instances.size(), placed);
  fmt::print("  spheres     {}\n", scene.spheres.size());
  if (const auto bounds = scene_bounds(scene))
    fmt::print("  bounds      {} to {}\n", vector_text(bounds->low), vector_text(bounds->high));
  fmt::print("  lights      {}\n", scene.lights.size());
  for (const Camera& camera : scene.cameras)
    fmt::print("  camera      {}{} at {}\n", camera.name.empty() ? "" : camera.name + ", ",
               camera.orthographic_height ? "orthographic" : "perspective",
               vector_text(camera.to_world.origin));
  for (const Texture& texture : scene.textures)
    fmt::print("  texture     {}, {} x {}, {} channels\n", texture.name, texture.image.width,
               texture.image.height, texture.image.channels);
  constexpr std::size_t most = 30;
  for (std::size_t i = 0; i < scene.materials.size() && i < most; ++i)
    fmt::print("  material    {}: {}\n", scene.materials[i].name, material_text(scene.materials[i]));
  if (scene.materials.size() > most)
    fmt::print("  and         {} more materials\n", scene.materials.size() - most);
}

void list_built_in() {
  for (const BuiltInScene& scene : built_in_scenes()) {
    fmt::print("{:<12} {}\n", scene.name, scene.description);
    if (!scene.parameters.empty()) fmt::print("{:<12}   {}\n", "", scene.parameters);
  }
}

void run(const SceneCommand& command) {
  if (command.input.empty()) return list_built_in();
  if (!command.output.empty() && extension_of(command.output) != ".glb")
    throw CLI::ValidationError("--output", "needs a name that ends in .glb");
  check_output(command.output, command.input);
  const Scene scene = open_scene(command.input);
  for (const std::string& warning : scene.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", scene.source, warning);
  fmt::print("{}\n", scene.source);
  print_counts(scene);
  if (!command.output.empty()) write_file(command.output, encode_glb(scene));
}

}  // namespace

void add_scene_command(CLI::App& app) {
  auto command = std::make_shared<SceneCommand>();
  CLI::App* sub = app.add_subcommand("scene", "What a scene holds; without INPUT, the built-in scenes");
  sub->add_option(
      "INPUT", command->input,
      "A .gltf, .glb, .obj or .ply file, or a built-in scene with its parameters, NAME:key=value,...");
  sub->add_option(
         "-o,--output", command->output,
         "Write it as GLB for other renderers: shapes, factors of materials, cameras; no textures or lights")
      ->needs("INPUT");
  sub->footer("Examples:\n  welkin scene bunny.glb\n  welkin scene plane -o plane.glb");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
