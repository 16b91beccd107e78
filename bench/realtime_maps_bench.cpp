#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "measure.h"

#include <tests/realtime/sphere_picture.h>
#include <welkin/brdf/fresnel_blend.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/brdf/models.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/sphere/resample.h>

// The techniques that look up prefiltered maps, each against the brute-force integral over a ball's pixels (n.v above 0.1):
// mean |error| over mean truth. Times are of a frame of 256 x 256, maps made before. FILE arguments replace the built-in
// skies. With PICTURES=FOLDER in the environment, rows of balls go there as PNG: the truth first.

namespace {

using namespace welkin;

constexpr int map_width = 128;  // brute force sums over every texel
const SphereView view{{1, 0.35f, 0.6f}, 48};

Material of_model(MaterialModel model) {
  Material material;
  material.model = model;
  material.compensated = false;
  material.base_color = {1, 1, 1};
  return material;
}

struct Case {
  std::string name;
  Material material;
  std::vector<double> (*truth)(const Image&, const Material&, std::span<const SpherePixel>);
  std::vector<const char*> techniques;
};

std::vector<double> diffuse_truth(const Image& map, const Material&, std::span<const SpherePixel> pixels) {
  return sphere_truth(map, make_lambert_brdf({1, 1, 1}), pixels);
}

std::vector<double> ggx_truth(const Image& map, const Material& m, std::span<const SpherePixel> pixels) {
  const double alpha = std::pow(static_cast<double>(m.perceptual_roughness), 2);
  return sphere_truth(map, make_ggx_brdf(alpha, {1, 1, 1}), pixels);
}

std::vector<double> phong_truth(const Image& map, const Material& m, std::span<const SpherePixel> pixels) {
  return sphere_truth(map, make_phong_brdf(static_cast<double>(m.exponent)), pixels);
}

std::vector<double> lafortune_truth(const Image& map, const Material& m,
                                    std::span<const SpherePixel> pixels) {
  const auto& c = m.lafortune_c;
  const LafortuneBrdf brdf{{}, {{c[0], c[1], c[2], static_cast<double>(m.exponent), {1, 1, 1}}}};
  std::vector<TangentQuery> queries;
  for (const SpherePixel& pixel : pixels) {
    const Vec3 n = pixel.query.normal;
    queries.push_back({n, normalized(Vec3{-n.z, 0, n.x}), pixel.query.view});
  }
  return reflect_lafortune_brute_force(map, brdf, queries);
}

// Phong's lobe of the width of the coat, as the technique has it: N = (1 / alpha^2 - 1) / 2.
std::vector<double> blend_truth(const Image& map, const Material& m, std::span<const SpherePixel> pixels) {
  FresnelBlendMaterial material;
  material.exponent = 0.5 * (1 / std::pow(static_cast<double>(m.perceptual_roughness), 4) - 1);
  material.albedo = {1, 1, 1};
  return sphere_truth(map, make_fresnel_blend_brdf(material), pixels);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"diffuse",
                 of_model(MaterialModel::lambert),
                 diffuse_truth,
                 {"irradiance-map", "sh-pixel", "sh-matrix"}});
  for (const float roughness : {0.3f, 0.5f, 0.7f}) {
    Material metal = of_model(MaterialModel::ggx);
    metal.perceptual_roughness = roughness;
    all.push_back(
        {fmt::format("ggx, roughness {}", roughness),
         metal,
         ggx_truth,
         {"prefiltered-ggx", "stretched", "view-elevation:lobes=1", "view-elevation", "prefiltered-phong"}});
  }
  for (const float exponent : {5.0f, 30.0f, 200.0f}) {
    Material phong = of_model(MaterialModel::phong);
    phong.exponent = exponent;
    all.push_back({fmt::format("phong, N {}", exponent),
                   phong,
                   phong_truth,
                   {"prefiltered-phong:lobe=published", "prefiltered-phong", "prefiltered-ggx"}});
  }
  const std::array<float, 3> weights[] = {{-1, -1, 0.7f}, {-0.95f, -0.6f, 0.9f}};
  for (const auto& c : weights) {
    Material lafortune = of_model(MaterialModel::lafortune);
    lafortune.lafortune_c = c;
    lafortune.exponent = 30;
    all.push_back({fmt::format("lafortune {}:{}:{}, N 30", c[0], c[1], c[2]),
                   lafortune,
                   lafortune_truth,
                   {"lafortune:lobe=published", "lafortune"}});
  }
  for (const float roughness : {0.25f, 0.5f}) {
    Material plastic = of_model(MaterialModel::metallic_roughness);
    plastic.metallic = 0;
    plastic.perceptual_roughness = roughness;
    all.push_back(
        {fmt::format("fresnel blend, roughness {}", roughness), plastic, blend_truth, {"fresnel-blend"}});
  }
  return all;
}

double milliseconds_of(const char* technique, const Material& material,
                       const std::shared_ptr<const EnvironmentData>& light) {
  Renderer renderer;
  const TechniqueChoice choice = parse_technique(technique);
  const Scene scene = sphere_scene(material, view);
  renderer.show_background = false;
  renderer.set_technique(*choice.technique, choice.values);
  renderer.set_camera(scene.cameras[0]);
  renderer.set_scene(scene);
  renderer.set_environment(light);
  renderer.resize(256, 256);
  return 1000 * bench::measure(9, [&] {
                  renderer.draw();
                  glFinish();
                }).median;
}

// Balls side by side: the truth from its pixels, then the techniques' own pictures.
void add_ball(Image& row, int index, const Image& picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) row.at(index * picture.width + x, y)[c] = picture.at(x, y)[c];
}

void save_row(const std::string& folder, const std::string& name, const Case& c, const Image& map,
              const std::shared_ptr<const EnvironmentData>& light) {
  const SphereView large{view.towards, 128};
  const auto pixels = sphere_pixels(large, 1, 0.01);
  const auto truth = c.truth(map, c.material, pixels);
  Image row(128 * (1 + static_cast<int>(c.techniques.size())), 128), ball(128, 128);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      ball.at(pixels[i].x, pixels[i].y)[k] = static_cast<float>(truth[3 * i + k]);
  add_ball(row, 0, ball);
  int index = 1;
  for (const char* technique : c.techniques)
    add_ball(row, index++, draw_sphere(technique, c.material, light, large));
  save_image(std::filesystem::path(folder) / (name + ".png"), row);
}

void run(const std::string& input) {
  const Environment loaded = load_environment(input);
  const Image map = resample({Mapping::equirectangular, loaded.radiance},
                             map_shape(Mapping::equirectangular, map_width / 2))
                        .image;
  IblOptions options;
  options.size = 256;
  const auto light = make_environment_data(map, options);
  const auto pixels = sphere_pixels(view, 2, 0.1);
  fmt::print("\n{}\n", loaded.source);
  const char* folder = std::getenv("PICTURES");
  int number = 0;
  for (const Case& c : cases()) {
    const auto truth = c.truth(map, c.material, pixels);
    for (const char* technique : c.techniques) {
      const SphereError error = sphere_error(draw_sphere(technique, c.material, light, view), pixels, truth);
      fmt::print("{:<34} {:<34} error {:>6.2f} %   {:>7.2f} ms\n", c.name, technique, 100 * error.mean,
                 milliseconds_of(technique, c.material, light));
      std::fflush(stdout);
    }
    if (folder != nullptr)
      save_row(folder, fmt::format("{}-{}", std::filesystem::path(input).stem().string(), number++), c, map,
               light);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const HeadlessContext context;
    std::vector<std::string> inputs(argv + 1, argv + argc);
    if (inputs.empty()) inputs = {"sky:day,elevation=30", "sky:studio"};
    for (const std::string& input : inputs) run(input);
  } catch (const Error& error) {
    fmt::print(stderr, "bench_realtime_maps: {}\n", error.what());
    return 1;
  }
  return 0;
}
