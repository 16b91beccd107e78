#include <welkin/brdf/models.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/brdf/ggx.h>
#include <welkin/error.h>

namespace welkin {
namespace {

using Rgb = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

// Throws unless low <= value <= high; NaN throws too.
void require(const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw Error(fmt::format("{} is {:g}; it must lie in [{:g}, {:g}]", what, value, low, high));
}

void require(const char* what, const Rgb& values, double low, double high) {
  for (double value : values) require(what, value, low, high);
}

Rgb scaled(const Rgb& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

std::string text_of(const Rgb& colour) {
  if (colour[0] == colour[1] && colour[1] == colour[2]) return fmt::format("{:g}", colour[0]);
  return fmt::format("{:g}:{:g}:{:g}", colour[0], colour[1], colour[2]);
}

// The half vector of a pair by its cosines: with the normal, and with the light (or the view, which is the same).
struct HalfVector {
  double cos_normal = 0, cos_light = 0;
};

// |light + view|^2 = 2 (1 + light.view); (light + view).n = cos_light + cos_view. Opposite grazing directions have none:
// zeros, for which every model here is dark.
HalfVector half_vector(double cos_light, double cos_view, double azimuth) {
  const double length2 = 2 * (1 + cos_between(cos_light, cos_view, azimuth));
  if (length2 < 1e-30) return {};
  const double length = std::sqrt(length2);
  return {std::min(1.0, (cos_light + cos_view) / length), length / 2};
}

template <class Fresnel>
IsotropicBrdf ggx_with(double alpha, std::string name, Fresnel fresnel) {
  require("ggx alpha", alpha, 1e-3, 1);
  IsotropicBrdf brdf;
  brdf.name = std::move(name);
  // 2 alpha at normal view; at view angle t the lobe is narrower by cos t across the plane of incidence: 60 degrees.
  brdf.angular_width = alpha;
  brdf.value = [alpha, fresnel](double cos_light, double cos_view, double azimuth) {
    const HalfVector half = half_vector(cos_light, cos_view, azimuth);
    const double dv = ggx_distribution(half.cos_normal, alpha) * ggx_visibility(cos_view, cos_light, alpha);
    Rgb value;
    for (int c = 0; c < 3; ++c) value[c] = dv * fresnel(c, half.cos_light);
    return value;
  };
  return brdf;
}

}  // namespace

double cos_between(double cos_light, double cos_view, double azimuth) {
  const double sines2 = (1 - cos_light) * (1 + cos_light) * (1 - cos_view) * (1 + cos_view);
  return std::clamp(cos_light * cos_view + std::sqrt(std::max(0.0, sines2)) * std::cos(azimuth), -1.0, 1.0);
}

IsotropicBrdf make_lambert_brdf(const Rgb& albedo) {
  require("lambert albedo", albedo, 0, 1);
  const Rgb value = scaled(albedo, 1 / pi);
  return {"lambert " + text_of(albedo), [value](double, double, double) { return value; }, 1};
}

// The mirrored view turns the azimuth by pi. At normal view the reflectance is the integral of cos^(N+1), 2 pi / (N + 2).
IsotropicBrdf make_phong_brdf(double exponent, const Rgb& scale) {
  require("phong exponent", exponent, 0, 1e6);
  require("phong scale", scale, 0, 1);
  const Rgb peak = scaled(scale, (exponent + 2) / (2 * pi));
  IsotropicBrdf brdf;
  brdf.name = fmt::format("phong {:g}, scale {}", exponent, text_of(scale));
  brdf.angular_width = 1 / std::sqrt(std::max(1.0, exponent));
  brdf.value = [exponent, peak](double cos_light, double cos_view, double azimuth) {
    const double cosine = cos_between(cos_light, cos_view, pi - azimuth);
    return cosine <= 0 ? Rgb{} : scaled(peak, std::pow(cosine, exponent));
  };
  return brdf;
}

// At normal view the half vector is at theta / 2: the integral of cos^N(theta/2) cos theta over the hemisphere, with
// c = cos(theta/2), is 8 pi times that of c^(N+1) (2 c^2 - 1) dc from sqrt(1/2) to 1, i.e. (Giesen 2009)
//   8 pi (2^(-N/2) + N) / ((N + 2) (N + 4)).
IsotropicBrdf make_blinn_phong_brdf(double exponent, const Rgb& scale) {
  require("blinn-phong exponent", exponent, 0, 1e6);
  require("blinn-phong scale", scale, 0, 1);
  const double norm = (exponent + 2) * (exponent + 4) / (8 * pi * (std::exp2(-exponent / 2) + exponent));
  const Rgb peak = scaled(scale, norm);
  IsotropicBrdf brdf;
  brdf.name = fmt::format("blinn-phong {:g}, scale {}", exponent, text_of(scale));
  brdf.angular_width = 1 / std::sqrt(std::max(1.0, exponent));
  brdf.value = [exponent, peak](double cos_light, double cos_view, double azimuth) {
    const double cosine = half_vector(cos_light, cos_view, azimuth).cos_normal;
    return cosine <= 0 ? Rgb{} : scaled(peak, std::pow(cosine, exponent));
  };
  return brdf;
}

IsotropicBrdf make_ggx_brdf(double alpha, const Rgb& f0) {
  require("ggx f0", f0, 0, 1);
  return ggx_with(alpha, fmt::format("ggx alpha {:g}, f0 {}", alpha, text_of(f0)),
                  [f0](int c, double cosine) { return fresnel_schlick(cosine, f0[c]); });
}

IsotropicBrdf make_ggx_dielectric_brdf(double alpha, double eta) {
  require("dielectric eta", eta, 1, 10);
  return ggx_with(alpha, fmt::format("ggx alpha {:g}, dielectric {:g}", alpha, eta),
                  [eta](int, double cosine) { return fresnel_dielectric(cosine, eta); });
}

IsotropicBrdf make_ggx_conductor_brdf(double alpha, const Rgb& eta, const Rgb& k) {
  require("conductor eta", eta, 0.01, 20);
  require("conductor k", k, 0, 20);
  return ggx_with(
      alpha, fmt::format("ggx alpha {:g}, conductor {} + i {}", alpha, text_of(eta), text_of(k)),
      [eta, k](int c, double cosine) { return std::min(1.0, fresnel_conductor(cosine, eta[c], k[c])); });
}

// h.h = 2 (1 + light.view), h.n = cos_light + cos_view, and tan^2 = h.h / (h.n)^2 - 1.
IsotropicBrdf make_ward_brdf(double alpha, const Rgb& specular) {
  require("ward alpha", alpha, 1e-3, 1);
  require("ward specular", specular, 0, 1);
  const double norm = 1 / (pi * alpha * alpha);
  IsotropicBrdf brdf;
  brdf.name = fmt::format("ward alpha {:g}, specular {}", alpha, text_of(specular));
  brdf.angular_width = alpha;
  brdf.value = [alpha, norm, specular](double cos_light, double cos_view, double azimuth) {
    const double hh = 2 * (1 + cos_between(cos_light, cos_view, azimuth));
    const double hn2 = (cos_light + cos_view) * (cos_light + cos_view);
    const double tan2 = std::max(0.0, hh / hn2 - 1);
    return scaled(specular, norm * std::exp(-tan2 / (alpha * alpha)) * hh / (hn2 * hn2));
  };
  return brdf;
}

}  // namespace welkin
