#include <algorithm>
#include <cmath>
#include <optional>

#include <welkin/realtime/techniques/sampled_environment.h>
#include <welkin/realtime/techniques/technique_list.h>

// The environment sampled in each pixel: `importance`, which adds up samples over frames until the picture is exact, and
// `filtered-importance`, which looks few samples up in a mip chain.

namespace welkin {
namespace {

enum Value { sampling, table, jacobian, samples, width, seed };

constexpr std::string_view sampling_names[] = {"brdf", "environment", "mis"};
constexpr std::string_view table_names[] = {"inverse", "alias", "rows"};
constexpr std::string_view jacobian_names[] = {"sphere", "lecture"};

constexpr Parameter importance_parameters[] = {
    {"sampling", "where directions come from: the material, the environment, or both", 0, 2, 2, true,
     sampling_names},
    {"table", "how a texel is found: CDFs by bisection, one look-up, or sums of rows", 0, 2, 0, true,
     table_names},
    {"jacobian", "the density: luminance by solid angle, or by texel as if the map were flat", 0, 1, 0, true,
     jacobian_names},
    {"samples", "per pixel and frame", 1, 64, 4, true, {}},
    {"width", "of the sampled map: wider ones are averaged down to it, texels", 16, 8192, 2048, true, {}},
    {"seed", "of the random numbers: pictures of different seeds are independent", 0, 65535, 0, true, {}},
};

constexpr int unit_map = first_technique_unit, unit_table = unit_map + 1, unit_sum = unit_map + 2,
              unit_energy = unit_map + 3, unit_average = unit_map + 4;

int whole(const ParameterValues& values, Value which) {
  return static_cast<int>(values[static_cast<std::size_t>(which)]);
}

SampledEnvironmentOptions options_of(const ParameterValues& values) {
  constexpr SamplingTableForm forms[] = {SamplingTableForm::cdf, SamplingTableForm::alias,
                                         SamplingTableForm::rows};
  SampledEnvironmentOptions options;
  options.form = forms[whole(values, table)];
  options.density = whole(values, jacobian) == 0 ? EnvironmentDensity::luminance_solid_angle
                                                 : EnvironmentDensity::luminance;
  options.largest_width = whole(values, width);
  return options;
}

bool same(const SampledEnvironmentOptions& a, const SampledEnvironmentOptions& b) {
  return a.form == b.form && a.density == b.density && a.largest_width == b.largest_width;
}

class Importance : public Technique {
 public:
  Importance() : energies_(upload_scatter_energies()), mean_("fullscreen.vert", "mean_of_samples.frag") {}

  bool progressive() const override { return true; }

  void draw(const Frame& frame, const ParameterValues& values) override {
    prepare(frame, values);
    const int count = whole(values, samples), before = frame.accumulated == 0 ? 0 : samples_done_;
    add_samples(frame, values, before);
    samples_done_ = before + count;
    show_mean(frame);
  }

 private:
  void prepare(const Frame& frame, const ParameterValues& values) {
    const SampledEnvironmentOptions options = options_of(values);
    if (!options_ || upload_ != frame.environment.upload || !same(*options_, options)) {
      if (!options_ || options_->form != options.form || options_->density != options.density)
        program_ =
            Program("mesh.vert", "importance.frag", sampled_environment_glsl(options.form, options.density));
      sampled_ = {};  // before the new one is made: both may not fit
      sampled_ = upload_sampled_environment(frame.light.radiance, options);
      options_ = options;
      upload_ = frame.environment.upload;
    }
    if (sums_[0].width == frame.target.width && sums_[0].height == frame.target.height) return;
    for (RenderTarget& sum : sums_) {
      sum = {};
      const TexelFormat exact = TexelFormat::rgba32f;
      sum = make_render_target(frame.target.width, frame.target.height, &exact, 1, true);
    }
  }

  void add_samples(const Frame& frame, const ParameterValues& values, int before) {
    const PassTimer::Scope timed(frame.timer, "importance.frag");
    newest_ = 1 - newest_;
    sums_[newest_].bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    program_.use();
    program_.set("sampling", sampled_.black ? 0 : whole(values, sampling));
    program_.set("samples", whole(values, samples));
    program_.set("samples_before", before);
    program_.set("seed", whole(values, seed));
    program_.set_linear("world_to_environment", world_to_environment(frame.environment.rotation_radians));
    program_.set_texture("equirect_map", unit_map, GL_TEXTURE_2D, sampled_.map);
    program_.set_texture("table_map", unit_table, GL_TEXTURE_2D,
                         sampled_.black ? sampled_.map : sampled_.table);
    program_.set_texture("sum_before", unit_sum, GL_TEXTURE_2D, sums_[1 - newest_].colors[0]);
    program_.set_texture("energy_map", unit_energy, GL_TEXTURE_2D, energies_.energies);
    program_.set_texture("energy_average_map", unit_average, GL_TEXTURE_2D, energies_.averages);
    draw_scene(program_, frame.scene, frame.view);
  }

  void show_mean(const Frame& frame) {
    const PassTimer::Scope timed(frame.timer, "mean_of_samples.frag");
    frame.target.bind();
    mean_.use();
    mean_.set("samples", static_cast<float>(samples_done_));
    mean_.set_texture("sum_map", unit_map, GL_TEXTURE_2D, sums_[newest_].colors[0]);
    mean_.set_texture("depth_map", unit_table, GL_TEXTURE_2D, sums_[newest_].depth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    frame.fullscreen.draw();
    glDepthFunc(GL_LESS);
  }

  ScatterEnergies energies_;
  Program program_, mean_;
  std::optional<SampledEnvironmentOptions> options_;
  std::uint64_t upload_ = 0;
  SampledEnvironment sampled_;
  RenderTarget sums_[2];
  int newest_ = 0, samples_done_ = 0;
};

// What surface.glsl makes of each model, as a model that is exactly that: powers of cosines as GGX of alpha^2 = 2 / (N + 2), conductors
// by what they reflect at normal incidence, two widths by the root of their product.
void keep_shown_models(Scene& scene) {
  const auto normal_reflectance = [](float eta, float k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  for (Material& m : scene.materials) {
    m.perceptual_roughness *= std::pow(1 - m.anisotropy * m.anisotropy, 0.25f);
    m.anisotropy = 0;
    switch (m.model) {
      case MaterialModel::oren_nayar: m.model = MaterialModel::lambert; break;
      case MaterialModel::phong:
      case MaterialModel::blinn_phong:
      case MaterialModel::lafortune:
        m.model = MaterialModel::ggx;
        m.perceptual_roughness = std::pow(2 / (m.exponent + 2), 0.25f);
        m.roughness_texture = {};
        break;
      case MaterialModel::ggx_conductor:
      case MaterialModel::conductor:
        m.perceptual_roughness *= m.model == MaterialModel::conductor ? 0.0f : 1.0f;
        m.model = MaterialModel::ggx;
        m.base_color = {normal_reflectance(m.eta.r, m.k.r), normal_reflectance(m.eta.g, m.k.g),
                        normal_reflectance(m.eta.b, m.k.b)};
        m.base_color_texture = {};
        break;
      case MaterialModel::dielectric: {
        const float f0 = normal_reflectance(m.ior, 0);
        m.model = MaterialModel::ggx;
        m.base_color = {f0, f0, f0};
        m.base_color_texture = {};
        m.perceptual_roughness = 0;
        break;
      }
      default: break;
    }
    // The path tracer's narrowest lobe; surface.glsl's metals without any width are mirrors.
    if (m.model == MaterialModel::ggx)
      m.perceptual_roughness = std::max(m.perceptual_roughness, std::sqrt(1e-3f));
  }
}

constexpr std::string_view pattern_names[] = {"same", "scrambled"};

constexpr Parameter filtered_parameters[] = {
    {"samples", "look-ups of a pixel", 1, 256, 16, true, {}},
    {"bias", "added to the mip level: more blur, fewer bands", -2, 4, 0, false, {}},
    {"pattern", "directions: the same in all pixels, or each with its own (noise for bands)", 0, 1, 0, true,
     pattern_names},
};

class FilteredImportance : public Technique {
 public:
  FilteredImportance()
      : energies_(upload_scatter_energies()), program_("mesh.vert", "filtered_importance.frag") {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    const PassTimer::Scope timed(frame.timer, "filtered_importance.frag");
    program_.use();
    set_environment(program_, frame.environment);
    program_.set("samples", static_cast<int>(values[0]));
    program_.set("level_bias", values[1]);
    program_.set("same_for_all", values[2] == 0 ? 1 : 0);
    program_.set_texture("energy_map", unit_energy, GL_TEXTURE_2D, energies_.energies);
    program_.set_texture("energy_average_map", unit_average, GL_TEXTURE_2D, energies_.averages);
    draw_scene(program_, frame.scene, frame.view);
  }

 private:
  ScatterEnergies energies_;
  Program program_;
};

std::unique_ptr<Technique> make_filtered() { return std::make_unique<FilteredImportance>(); }

std::unique_ptr<Technique> make_importance() { return std::make_unique<Importance>(); }

constexpr TechniqueInfo rows[] = {
    {"importance", "the environment sampled in each pixel, more samples every frame: converges to the truth",
     "Veach & Guibas 1995; Pharr, Jakob & Humphreys 2016", Truth::unshadowed, importance_parameters,
     make_importance, keep_shown_models},
    {"filtered-importance", "glossy by few directions of the material, each a look-up in the mip of its size",
     "Krivanek & Colbert 2008", Truth::unshadowed, filtered_parameters, make_filtered, keep_shown_models},
};

}  // namespace

std::span<const TechniqueInfo> importance_techniques() { return rows; }

}  // namespace welkin
