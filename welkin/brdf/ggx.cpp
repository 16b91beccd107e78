#include <welkin/brdf/ggx.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

double square(double x) { return x * x; }

}  // namespace

double ggx_distribution(double cos_half, double alpha) {
  if (cos_half <= 0) return 0;
  // cos^2 (alpha^2 - 1) + 1 = alpha^2 cos^2 + sin^2; the second form does not cancel for small alpha near cos
  // = 1.
  const double alpha2 = square(alpha);
  const double sin2 = (1 - cos_half) * (1 + cos_half);
  return alpha2 / (std::numbers::pi * square(alpha2 * square(cos_half) + sin2));
}

double ggx_lambda(double cosine, double alpha) {
  const double tan2 = (1 - cosine) * (1 + cosine) / square(cosine);
  const double x = square(alpha) * tan2;
  // (sqrt(1 + x) - 1) / 2 without cancellation for small x.
  return x / (2 * (std::sqrt(1 + x) + 1));
}

double ggx_masking(double cosine, double alpha) {
  return cosine <= 0 ? 0 : 1 / (1 + ggx_lambda(cosine, alpha));
}

double ggx_masking_shadowing(double cos_view, double cos_light, double alpha) {
  if (cos_view <= 0 || cos_light <= 0) return 0;
  return 1 / (1 + ggx_lambda(cos_view, alpha) + ggx_lambda(cos_light, alpha));
}

// With S(c) = sqrt(alpha^2 + (1 - alpha^2) c^2), 1 + 2 Lambda(c) = S(c) / c, hence
// G2 = 2 / (S(v)/v + S(l)/l) and V = G2 / (4 v l) = 1 / (2 (l S(v) + v S(l))).
double ggx_visibility(double cos_view, double cos_light, double alpha) {
  if (cos_view <= 0 || cos_light <= 0) return 0;
  const double alpha2 = square(alpha);
  const double s_view = std::sqrt(alpha2 + (1 - alpha2) * square(cos_view));
  const double s_light = std::sqrt(alpha2 + (1 - alpha2) * square(cos_light));
  return 1 / (2 * (cos_light * s_view + cos_view * s_light));
}

double fresnel_schlick(double cosine, double f0, double f90) {
  const double x = std::clamp(1 - cosine, 0.0, 1.0);
  const double x2 = square(x);
  return f0 + (f90 - f0) * x2 * x2 * x;
}

double fresnel_dielectric(double cosine, double eta) {
  const double sin2_refracted = (1 - square(cosine)) / square(eta);
  if (sin2_refracted >= 1) return 1;
  const double cos_refracted = std::sqrt(1 - sin2_refracted);
  const double perpendicular = (cosine - eta * cos_refracted) / (cosine + eta * cos_refracted);
  const double parallel = (eta * cosine - cos_refracted) / (eta * cosine + cos_refracted);
  return (square(perpendicular) + square(parallel)) / 2;
}

// Born & Wolf, Principles of Optics, section 14.2: a^2 + b^2 is the modulus of (eta + i k)^2 - sin^2.
double fresnel_conductor(double cosine, double eta, double k) {
  const double cos2 = square(cosine);
  const double sin2 = 1 - cos2;
  const double real = square(eta) - square(k) - sin2;
  const double a2_plus_b2 = std::sqrt(square(real) + 4 * square(eta * k));
  const double a = std::sqrt(std::max(0.0, (a2_plus_b2 + real) / 2));
  const double perpendicular = (a2_plus_b2 + cos2 - 2 * a * cosine) / (a2_plus_b2 + cos2 + 2 * a * cosine);
  const double far = cos2 * a2_plus_b2 + square(sin2);
  const double near = 2 * a * cosine * sin2;
  const double parallel = perpendicular * (far - near) / (far + near);
  return (perpendicular + parallel) / 2;
}

// Heitz 2018: stretch the view by alpha so that the surface becomes a hemisphere, pick a point of the
// hemisphere's projection towards the view uniformly (a disc, its lower part squeezed into the half that is
// seen), unstretch.
LocalVec sample_ggx_visible_normal(LocalVec view, double alpha, double u1, double u2) {
  assert(view.z > 0);
  const double stretched_length = std::hypot(alpha * view.x, alpha * view.y, view.z);
  const LocalVec v{alpha * view.x / stretched_length, alpha * view.y / stretched_length,
                   view.z / stretched_length};
  const double across = std::hypot(v.x, v.y);
  const LocalVec t1 = across > 0 ? LocalVec{-v.y / across, v.x / across, 0} : LocalVec{1, 0, 0};
  const LocalVec t2{v.y * t1.z - v.z * t1.y, v.z * t1.x - v.x * t1.z, v.x * t1.y - v.y * t1.x};

  const double radius = std::sqrt(u1);
  const double angle = 2 * std::numbers::pi * u2;
  const double p1 = radius * std::cos(angle);
  const double visible = (1 + v.z) / 2;
  const double p2 =
      (1 - visible) * std::sqrt(std::max(0.0, 1 - square(p1))) + visible * radius * std::sin(angle);
  const double p3 = std::sqrt(std::max(0.0, 1 - square(p1) - square(p2)));

  const double x = alpha * (p1 * t1.x + p2 * t2.x + p3 * v.x);
  const double y = alpha * (p1 * t1.y + p2 * t2.y + p3 * v.y);
  const double z = std::max(0.0, p1 * t1.z + p2 * t2.z + p3 * v.z);
  const double scale = 1 / std::hypot(x, y, z);
  return {scale * x, scale * y, scale * z};
}

double ggx_visible_normal_pdf(LocalVec view, LocalVec normal, double alpha) {
  if (view.z <= 0) return 0;
  return ggx_masking(view.z, alpha) * std::max(0.0, dot(view, normal)) * ggx_distribution(normal.z, alpha) /
         view.z;
}

}  // namespace welkin
