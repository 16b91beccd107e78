#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <welkin/brdf/models.h>
#include <welkin/envmap/reflection/lobe_stack.h>
#include <welkin/realtime/technique.h>
#include <welkin/realtime/techniques/technique_list.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/mapping.h>

// A stack of maps per material and elevation of the view (Kautz & McCool 2000). Each stack belongs to one width and one
// reflectance, so roughness cannot vary over a surface. Fits take a second and more a material: the others of a scene with
// more than `most_stacks` different ones, and smooth ones, look up the chain of prefiltered-ggx.

namespace welkin {
namespace {

constexpr int views = 16;  // VIEWS of view_elevation.frag
constexpr int most_stacks = 8;
constexpr double least_alpha = 0.03;  // below, the maps would have to be finer than they are

// What decides the shape of a material's lobes.
using Shape = std::pair<int, int>;  // alpha in 1/1000, F0 in 1/50

struct Stack {
  GlTexture slices;
  std::vector<Vec3f> angles;  // of the view, of the first axis, of the second
  int lobes = 0, size = 0;
};

// A texel of the border continues the map on the other side of the edge's middle.
Image octahedral_slice(const Cube& cube, int size, float share) {
  const MapShape shape = map_shape(Mapping::octahedral, size);
  Image slice(size + 2, size + 2);
  for (int row = 0; row < slice.height; ++row) {
    for (int column = 0; column < slice.width; ++column) {
      int x = column - 1, y = row - 1;
      if (x < 0 || x >= size) x = std::clamp(x, 0, size - 1), y = size - 1 - y;
      if (y < 0 || y >= size) y = std::clamp(y, 0, size - 1), x = size - 1 - x;
      float* texel = slice.at(column, row);
      look_up_cube(cube, map_texel_direction(shape, x, y), texel);
      for (int c = 0; c < 3; ++c) texel[c] *= share;
    }
  }
  return slice;
}

Stack make_stack(const Image& radiance, Shape shape, int lobes) {
  const double f0 = shape.second / 50.0;
  LobeStackOptions options;
  options.lobes = lobes;
  options.views = views;
  options.largest_size = 64;
  const LobeStack fitted =
      prepare_lobe_stack(radiance, make_ggx_brdf(shape.first / 1000.0, {f0, f0, f0}), options);
  Stack stack;
  stack.lobes = lobes;
  for (const Cube& cube : fitted.cubes) stack.size = std::max(stack.size, 2 * cube.size);
  std::vector<Image> slices(fitted.slots.size());
  for (std::size_t view = 0; view < fitted.view_angles.size(); ++view) {
    const StackLobe* slots = &fitted.slots[view * static_cast<std::size_t>(lobes)];
    double total = 0;
    for (int j = 0; j < lobes; ++j) total += slots[j].energy[0];
    for (int j = 0; j < lobes; ++j)
      slices[static_cast<std::size_t>(j * views) + view] =
          octahedral_slice(fitted.cubes[static_cast<std::size_t>(slots[j].cube)], stack.size,
                           static_cast<float>(slots[j].energy[0] / std::max(total, 1e-12)));
    stack.angles.push_back({static_cast<float>(fitted.view_angles[view]), static_cast<float>(slots[0].axis),
                            static_cast<float>(slots[lobes - 1].axis)});
  }
  stack.slices = upload_volume(slices);
  return stack;
}

// Widths and F0 as gpu_scene.cpp gives them to the shader; -1: no glossy lobe, or none that a stack could hold.
Shape shape_of(const Material& m) {
  double alpha = m.perceptual_roughness * m.perceptual_roughness * std::sqrt(1 - m.anisotropy * m.anisotropy);
  const double coat = std::pow((m.ior - 1) / (m.ior + 1), 2),
               colour = (m.base_color.r + m.base_color.g + m.base_color.b) / 3;
  double f0 = colour;
  switch (m.model) {
    case MaterialModel::metallic_roughness: f0 = m.metallic * colour + (1 - m.metallic) * coat; break;
    case MaterialModel::coated_diffuse: f0 = coat; break;
    case MaterialModel::ggx: break;
    case MaterialModel::ggx_conductor: f0 = 0.7; break;
    case MaterialModel::phong:
    case MaterialModel::blinn_phong:
    case MaterialModel::lafortune: alpha = std::sqrt(2 / (m.exponent + 2.0)); break;
    default: return {-1, -1};
  }
  if (alpha < least_alpha) return {-1, -1};
  return {static_cast<int>(std::lround(1000 * std::min(alpha, 1.0))),
          static_cast<int>(std::lround(50 * std::clamp(f0, 0.0, 1.0)))};
}

class ViewElevation : public Technique, private MaterialListener {
 public:
  void draw(const Frame& frame, const ParameterValues& values) override {
    prepare(frame, values.empty() ? 1 : static_cast<int>(values[0]) + 1);
    const PassTimer::Scope timed(frame.timer, "view_elevation.frag");
    scene_ = &frame.scene;
    program_.use();
    set_environment(program_, frame.environment);
    program_.set("stack_map", first_technique_unit);
    draw_scene(program_, frame.scene, frame.view, this);
  }

 private:
  void prepare(const Frame& frame, int lobes) {
    if (made_for_ != frame.environment.upload || lobes_ != lobes) stacks_.clear();
    made_for_ = frame.environment.upload;
    lobes_ = lobes;
    for (const Material& material : frame.scene.materials) {
      const Shape shape = shape_of(material);
      if (shape.first < 0 || stacks_.size() >= most_stacks || stacks_.count(shape) > 0) continue;
      stacks_.emplace(shape, make_stack(frame.light.radiance, shape, lobes));
    }
  }

  void material_set(const Program& program, int material) override {
    const auto found = stacks_.find(shape_of(scene_->materials[static_cast<std::size_t>(material)]));
    program.set("stack_lobes", found == stacks_.end() ? 0 : found->second.lobes);
    if (found == stacks_.end()) return;
    program.set("stack_size", static_cast<float>(found->second.size));
    program.set_vec3_array("stack_views", found->second.angles);
    bind_texture(first_technique_unit, GL_TEXTURE_3D, found->second.slices);
  }

  Program program_{"mesh.vert", "view_elevation.frag"};
  std::map<Shape, Stack> stacks_;
  std::uint64_t made_for_ = 0;
  int lobes_ = 0;
  const GpuScene* scene_ = nullptr;
};

double mean_of_channel(const Image& image, int channel) {
  double sum = 0;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t c = std::min(static_cast<std::size_t>(channel), channels - 1);
  for (std::size_t i = c; i < image.pixels.size(); i += channels) sum += static_cast<double>(image.pixels[i]);
  return sum / static_cast<double>(image.pixels.size() / channels);
}

void replace_by_mean(const Scene& scene, TextureUse& use, float& factor) {
  if (use.texture < 0) return;
  factor *= static_cast<float>(
      mean_of_channel(scene.textures[static_cast<std::size_t>(use.texture)].image, use.channel));
  use.texture = -1;
}

// A stack has one width: textures of roughness and metalness become their means.
void make_even(Scene& scene) {
  for (Material& material : scene.materials) {
    replace_by_mean(scene, material.roughness_texture, material.perceptual_roughness);
    replace_by_mean(scene, material.metallic_texture, material.metallic);
  }
}

constexpr std::string_view lobe_counts[] = {"1", "2"};
constexpr Parameter parameters[] = {
    {"lobes", "fitted to each elevation of the view", 0, 1, 0, true, lobe_counts},
};

constexpr TechniqueInfo table[] = {
    {"view-elevation",
     "glossy by a stack of maps for each material, filtered with the lobes that fit each elevation of the "
     "view",
     "Kautz & McCool 2000", Truth::unshadowed, parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<ViewElevation>()); }, make_even},
};

}  // namespace

std::span<const TechniqueInfo> view_elevation_techniques() { return table; }

}  // namespace welkin
