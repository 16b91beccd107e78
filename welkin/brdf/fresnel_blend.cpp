#include <welkin/brdf/fresnel_blend.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/brdf/ggx.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

void check(const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw Error(fmt::format("{} must lie in [{:g}, {:g}], not {}", what, low, high, value));
}

}  // namespace

void check_fresnel_blend(const FresnelBlendMaterial& material) {
  for (double a : material.albedo) check("the albedo", a, 0, 1);
  check("the exponent", material.exponent, 0, 1e6);
  for (double f : material.fresnel.f0) check("f0", f, 0, 1);
  for (double eta : material.fresnel.eta) check("eta", eta, 0.01, 20);
  for (double k : material.fresnel.k) check("k", k, 0, 20);
}

namespace {

// cos^N of the angle between the light and the mirrored view: z as it is, the rest turned by pi.
double phong(double cos_light, double cos_view, double azimuth, double exponent) {
  const double cosine = cos_between(cos_light, cos_view, azimuth + pi);
  return cosine > 0 ? (exponent + 1) / (2 * pi) * std::pow(std::min(1.0, cosine), exponent) : 0;
}

}  // namespace

std::array<double, 3> reflectance(const FresnelLaw& law, double cosine) {
  std::array<double, 3> result{};
  for (int c = 0; c < 3; ++c) switch (law.kind) {
      case FresnelLaw::Kind::dielectric: result[c] = fresnel_dielectric(cosine, law.eta[c]); break;
      case FresnelLaw::Kind::conductor: result[c] = fresnel_conductor(cosine, law.eta[c], law.k[c]); break;
      default: result[c] = fresnel_schlick(cosine, law.f0[c]);
    }
  return result;
}

IsotropicBrdf make_fresnel_blend_brdf(const FresnelBlendMaterial& material) {
  check_fresnel_blend(material);
  const auto value = [material](double cos_light, double cos_view, double azimuth) {
    // v.h = sqrt((1 + v.l) / 2).
    const double cos_half = std::sqrt(std::max(0.0, 0.5 * (1 + cos_between(cos_light, cos_view, azimuth))));
    const std::array<double, 3> f = reflectance(material.fresnel, std::min(1.0, cos_half));
    const double lobe = phong(cos_light, cos_view, azimuth, material.exponent) / std::max(cos_light, 1e-9);
    std::array<double, 3> result{};
    for (int c = 0; c < 3; ++c) result[c] = (1 - f[c]) * material.albedo[c] / pi + f[c] * lobe;
    return result;
  };
  return {fmt::format("fresnel blend, phong {:g}", material.exponent), value,
          1 / std::sqrt(material.exponent + 1)};
}

}  // namespace welkin
