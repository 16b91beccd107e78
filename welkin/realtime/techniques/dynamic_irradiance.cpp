#include <algorithm>
#include <cmath>

#include <welkin/envmap/zonal_kernel.h>
#include <welkin/realtime/capture/dynamic_light.h>
#include <welkin/realtime/techniques/dynamic_choices.h>
#include <welkin/realtime/techniques/technique_list.h>

// Dynamic irradiance maps (King 2005): the surroundings are captured, projected to spherical harmonics, convolved and turned back into a cube map each frame.

namespace welkin {
namespace {

constexpr int lobe_size = 32, lobe_unit = first_technique_unit;
constexpr int largest_degree = 8;
constexpr float default_exponent = 20;

// The first exponent of the scene; one map serves all.
float exponent_of(const std::vector<Material>& materials) {
  for (const Material& material : materials)
    if (material.model == MaterialModel::phong) return material.exponent;
  return default_exponent;
}

class DynamicIrradiance : public Technique {
 public:
  explicit DynamicIrradiance(bool phong)
      : program_("mesh.vert", "dynamic_irradiance.frag", phong ? "#define PHONG\n" : ""), phong_(phong) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    const float exponent = exponent_of(frame.scene.materials);
    DynamicLightOptions options;
    const auto whole = [&values](std::size_t i) { return static_cast<int>(values[i]); };
    options.around = static_cast<SurroundingsKind>(whole(0));
    options.sky = whole(1);
    options.input = static_cast<CaptureInput>(whole(2));
    options.size = whole(3);
    options.projection = static_cast<ShProjectionMethod>(whole(4));
    options.degree = whole(5) > 0 ? whole(5) : degree_for(exponent);
    options.bounces = whole(6);
    options.flare_radiance = values[7];
    options.patches = whole(8);
    light_.update(frame, options);
    if (phong_) draw_lobe(frame, options.degree, exponent);
    shade(frame);
  }

  Cube captured_environment() const override {
    return light_.ready() ? light_.capture().read_as_cube() : Cube{};
  }

 private:
  // Ramamoorthi & Hanrahan 2001: degree 2 for Lambert; for Phong about the root of the exponent, where the lobe has let 60 % of a degree through.
  int degree_for(float exponent) const {
    if (!phong_) return 2;
    return std::clamp(static_cast<int>(std::ceil(1.5f * std::sqrt(exponent))), 2, largest_degree);
  }

  void draw_lobe(const Frame& frame, int degree, float exponent) {
    if (!lobe_ || degree != degree_ || exponent != exponent_) {
      lobe_.emplace(lobe_size,
                    legendre_coefficients(make_phong_kernel(static_cast<double>(exponent)), degree));
      degree_ = degree, exponent_ = exponent;
    }
    const PassTimer::Scope timed(frame.timer, "phong cube");
    lobe_->draw(light_.projector().coefficients(), frame.fullscreen);
  }

  void shade(const Frame& frame) {
    const View view = light_.view_of(frame);
    frame.target.bind();
    {
      const PassTimer::Scope timed(frame.timer, "scene");
      program_.use();
      const GlTexture& cube = phong_ ? lobe_->cube() : light_.irradiance().cube();
      program_.set_texture("lobe_map", lobe_unit, GL_TEXTURE_CUBE_MAP, cube);
      draw_scene(program_, frame.scene, view);
    }
    light_.draw_around(frame, view);
  }

  Program program_;
  bool phong_;
  DynamicLight light_;
  std::optional<LobeCube> lobe_;
  int degree_ = 0;
  float exponent_ = 0;
};

std::unique_ptr<Technique> make_lambert() { return std::make_unique<DynamicIrradiance>(false); }
std::unique_ptr<Technique> make_phong() { return std::make_unique<DynamicIrradiance>(true); }

void make_diffuse(Scene& scene) {
  for (Material& material : scene.materials) material.model = MaterialModel::lambert;
}

void make_phong_materials(Scene& scene) {
  const float exponent = exponent_of(scene.materials);
  for (Material& material : scene.materials) {
    material.model = MaterialModel::phong;
    material.exponent = exponent;
    material.compensated = false;
  }
}

constexpr std::string_view inputs[] = {"cube", "paraboloid", "paraboloid-warped"};
constexpr std::string_view projections[] = {"tiled", "staged", "compute"};

constexpr Parameter parameters[] = {
    {"around", "what moves around the scene", 0, 3, 1, true, around},
    {"sky", "the environment, or a day of 60 s", 0, 1, 0, true, skies},
    {"capture", "what the surroundings are drawn into", 0, 2, 0, true, inputs},
    {"size", "texels along an edge of the capture", 8, 256, 64, true, {}},
    {"projection", "how coefficients are summed up", 0, 2, 1, true, projections},
    {"degree", "of the spherical harmonics; 0: as the lobe needs", 0, largest_degree, 0, true, {}},
    {"bounces", "times that light goes from the surroundings to the surroundings", 0, 3, 1, true, {}},
    {"flare", "radiance of the flares, W/(sr m^2)", 0, 2000, 150, false, {}},
    {"patches", "walls are cut into so many times so many", 1, 32, 8, true, {}},
};

constexpr TechniqueInfo table[] = {
    {"dynamic-irradiance", "diffuse, by an irradiance map of moving surroundings that is made each frame",
     "King 2005", Truth::dynamic, parameters, make_lambert, make_diffuse},
    {"dynamic-phong",
     "Phong's lobe, by a specular irradiance map of moving surroundings that is made each frame", "King 2005",
     Truth::dynamic, parameters, make_phong, make_phong_materials},
};

}  // namespace

std::span<const TechniqueInfo> dynamic_irradiance_techniques() { return table; }

}  // namespace welkin
