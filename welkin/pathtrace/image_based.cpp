#include <welkin/pathtrace/image_based.h>

#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/sphere/cube_lookup.h>

namespace welkin {
namespace {

constexpr Rgb white{1, 1, 1};

// What an engine's metallic-roughness shader reads.
struct EngineMaterial {
  Rgb diffuse;  // (1 - metallic) base color
  Rgb f0, f90 = white;
  float coat_f0 = 0, coat_f90 = 1;  // of the dielectric part, over the diffuse
  float alpha = 0;                  // 0: a mirror
  bool compensated = false;
};

Rgb conductor_f0(const Scatter& s) {
  const auto f0 = [](float eta, float k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  return {f0(s.eta.r, s.k.r), f0(s.eta.g, s.k.g), f0(s.eta.b, s.k.b)};
}

EngineMaterial diffuse_material(const Scatter& s) {
  EngineMaterial m;
  m.diffuse = s.color;
  m.f90 = {};
  m.coat_f90 = 0;
  return m;
}

EngineMaterial metal(Rgb f0, float alpha) {
  EngineMaterial m;
  m.f0 = f0;
  m.alpha = alpha;
  return m;
}

EngineMaterial coated(const Scatter& s, float metallic, float alpha) {
  EngineMaterial m;
  m.diffuse = (1 - metallic) * s.color;
  m.f0 = (1 - metallic) * s.f0 * white + metallic * s.color;
  m.f90 = (1 - metallic) * s.f90 * white + metallic * white;
  m.coat_f0 = s.f0;
  m.coat_f90 = s.f90;
  m.alpha = alpha;
  return m;
}

EngineMaterial engine_material(const Scatter& s) {
  const float alpha = std::sqrt(s.alpha_x * s.alpha_y);
  EngineMaterial m;
  switch (s.model) {
    case ScatterModel::lambert:
    case ScatterModel::oren_nayar: return diffuse_material(s);
    case ScatterModel::phong:
    case ScatterModel::blinn_phong:
    case ScatterModel::lafortune: m = metal(s.color, std::sqrt(2 / (s.exponent + 2))); break;
    case ScatterModel::ggx:
      m = metal(s.color, alpha);
      m.f90 = s.f90 * white;
      break;
    case ScatterModel::ggx_conductor: m = metal(conductor_f0(s), alpha); break;
    case ScatterModel::mirror:
      m = metal(s.color, 0);
      m.f90 = s.color;
      break;
    case ScatterModel::conductor: m = metal(conductor_f0(s), 0); break;
    case ScatterModel::dielectric: {
      const float f = (s.eta.r - 1) / (s.eta.r + 1);
      m = metal(f * f * white, 0);
      break;
    }
    case ScatterModel::coated_diffuse: m = coated(s, 0, std::max(0.0f, s.alpha_x)); break;
    case ScatterModel::metallic_roughness: m = coated(s, s.metallic, alpha); break;
  }
  m.compensated = s.compensated;
  return m;
}

float reflectance(const DfgValue& dfg, float f0, float f90, bool compensated) {
  const float single = f0 * static_cast<float>(dfg.scale) + f90 * static_cast<float>(dfg.bias);
  return compensated ? single * static_cast<float>(multiple_scattering_factor(f0, dfg.albedo())) : single;
}

Vec3 wide(Vec3f v) { return {v.x, v.y, v.z}; }

}  // namespace

ImageBasedLight make_image_based_light(IblSet&& set, const IblOptions& options) {
  return {std::move(set.specular), std::move(set.irradiance), std::move(set.dfg), options.law,
          options.dfg_form};
}

Rgb image_based_radiance(const ImageBasedLight& light, const Scatter& scatter, Vec3f normal, Vec3f view) {
  const EngineMaterial m = engine_material(scatter);
  const double roughness = std::sqrt(std::clamp(m.alpha, 0.0f, 1.0f));
  const double cos_view = std::clamp(dot(normal, view), 0.0f, 1.0f);
  // Without roughness the table's first row, which is half a texel off, is replaced by Schlick's term itself.
  const DfgValue dfg = m.alpha > 0 ? look_up_dfg(light.dfg, cos_view, roughness) : integrate_dfg(cos_view, 0);
  const bool compensated = m.compensated && light.form == DfgForm::scale_bias;
  const auto reflected_share = [&](float f0, float f90) { return reflectance(dfg, f0, f90, compensated); };

  Rgb result;
  if (!is_black(m.f0) || !is_black(m.f90)) {
    const int levels = static_cast<int>(light.specular.levels.size());
    const double level =
        perceptual_roughness_to_level(light.law, roughness, levels, light.specular.levels[0].size);
    float glossy[3];
    look_up_cube(light.specular, wide(reflected(view, normal)), level, glossy);
    result = Rgb{reflected_share(m.f0.r, m.f90.r), reflected_share(m.f0.g, m.f90.g),
                 reflected_share(m.f0.b, m.f90.b)} *
             Rgb{glossy[0], glossy[1], glossy[2]};
  }
  if (!is_black(m.diffuse)) {
    float irradiance[3];
    look_up_cube(light.irradiance, wide(normal), irradiance);
    const float passed = std::max(0.0f, 1 - reflected_share(m.coat_f0, m.coat_f90));
    result +=
        (passed / std::numbers::pi_v<float>)*m.diffuse * Rgb{irradiance[0], irradiance[1], irradiance[2]};
  }
  return result;
}

}  // namespace welkin
