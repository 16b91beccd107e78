#include <welkin/sh/forms/form.h>

#include <cassert>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/degree2_constants.h>
#include <welkin/sh/quadric.h>

namespace welkin {

using namespace degree2;

namespace {

using Nine = std::array<double, 9>;  // one channel, in our order 00, 1-1, 10, 11, 2-2, 2-1, 20, 21, 22

// What irradiance over pi has of the radiance, by coefficient: A_l / pi = 1, 2/3, 1/4.
constexpr Nine cosine_over_pi{1, 2. / 3, 2. / 3, 2. / 3, 1. / 4, 1. / 4, 1. / 4, 1. / 4, 1. / 4};
// (-1)^m: the Condon-Shortley sign.
constexpr Nine condon_shortley{1, -1, 1, -1, 1, -1, 1, -1, 1};

Nine times(Nine a, const Nine& b) {
  for (std::size_t i = 0; i < 9; ++i) a[i] *= b[i];
  return a;
}

Nine over(Nine a, const Nine& b) {
  for (std::size_t i = 0; i < 9; ++i) a[i] /= b[i];
  return a;
}

// n^T A n + 2 b.n + c with n' = M n as its argument has A' = M A M^T, b' = M b, whatever M mirrors or swaps.
SphereQuadric in_axes(const SphereQuadric& q, const Mat3& axes) {
  const Mat3 a{{Vec3{q.xx, q.xy, q.xz}, Vec3{q.xy, q.yy, q.yz}, Vec3{q.xz, q.yz, q.zz}}};
  const auto& [x, y, z] = axes.rows;
  return {dot(x, a * x), dot(y, a * y), dot(z, a * z), dot(x, a * y),
          dot(y, a * z), dot(x, a * z), axes * q.b,    q.c};
}

Nine in_axes(const Nine& c, const Mat3& axes) {
  Nine result;
  sh_from_quadric(in_axes(quadric_from_sh(c), axes), result);
  return result;
}

// Babylon's SphericalPolynomial: x, y, z, xx, yy, zz, yz, zx, xy. FromHarmonics makes it of harmonics H with the
// Condon-Shortley sign as the polynomial of H once more convolved with the cosine, over pi; what the material then
// evaluates is H itself, got back by FromPolynomial. H is irradiance over pi, so the polynomial has A_l / pi twice.
Nine babylon_polynomial(const Nine& radiance) {
  const SphereQuadric q = quadric_from_sh(times(times(radiance, cosine_over_pi), cosine_over_pi));
  return {2 * q.b.x, 2 * q.b.y, 2 * q.b.z, q.c + q.xx, q.c + q.yy, q.c + q.zz, 2 * q.yz, 2 * q.xz, 2 * q.xy};
}

Nine radiance_of_babylon(const Nine& p) {
  const double c = (p[3] + p[4] + p[5]) / 3;
  const SphereQuadric q{
      p[3] - c, p[4] - c, p[5] - c, p[8] / 2, p[6] / 2, p[7] / 2, 0.5 * Vec3{p[0], p[1], p[2]}, c};
  Nine twice;
  sh_from_quadric(q, twice);
  return over(over(twice, cosine_over_pi), cosine_over_pi);
}

// The engine's number is this times the coefficient of the radiance in the engine's axes.
Nine factors_of(ShForm form) {
  switch (form) {
    case ShForm::three: return {1, 1, 1, 1, 1, 1, 1, 1, 1};
    case ShForm::unreal: return condon_shortley;
    case ShForm::godot: {
      Nine factors;
      factors.fill(std::numbers::inv_pi);
      return factors;
    }
    default: return times({y00, y1, y1, y1, y2, y2, y20, y2, y22}, cosine_over_pi);
  }
}

}  // namespace

std::string_view sh_form_name(ShForm form) {
  constexpr std::string_view names[] = {"json",   "three", "babylon", "filament", "unity",
                                        "unreal", "godot", "c",       "glsl",     "hlsl"};
  return names[static_cast<std::size_t>(form)];
}

ShForm parse_sh_form(std::string_view name) {
  std::string list;
  for (ShForm form : all_sh_forms) {
    if (name == sh_form_name(form)) return form;
    list += (list.empty() ? "" : ", ") + std::string(sh_form_name(form));
  }
  throw Error("unknown form '" + std::string(name) + "'; choose one of " + list);
}

Mat3 sh_form_axes(ShForm form) {
  constexpr Mat3 mirrored_x{{Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  constexpr Mat3 swapped_yz{{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}};
  switch (form) {
    case ShForm::babylon:
    case ShForm::unity: return mirrored_x;
    case ShForm::unreal: return swapped_yz;
    default: return {};
  }
}

ShQuantity sh_form_quantity(ShForm form) {
  assert(form != ShForm::json);
  return form == ShForm::three ? ShQuantity::irradiance : ShQuantity::irradiance_over_pi;
}

ShFormNumbers to_sh_form(const ShCoefficients& radiance, ShForm form) {
  assert(form != ShForm::json && radiance.channels == 3 && radiance.max_degree <= 2);
  const ShCoefficients nine = resize(radiance, 2);
  ShFormNumbers numbers;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Nine c;
    for (std::size_t i = 0; i < 9; ++i) c[i] = nine.values[i * 3 + channel];
    c = in_axes(c, sh_form_axes(form));
    c = form == ShForm::babylon ? babylon_polynomial(c) : times(c, factors_of(form));
    for (std::size_t i = 0; i < 9; ++i) numbers[i * 3 + channel] = c[i];
  }
  return numbers;
}

ShCoefficients from_sh_form(const ShFormNumbers& numbers, ShForm form) {
  assert(form != ShForm::json);
  ShCoefficients radiance(2, 3);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Nine c;
    for (std::size_t i = 0; i < 9; ++i) c[i] = numbers[i * 3 + channel];
    c = form == ShForm::babylon ? radiance_of_babylon(c) : over(c, factors_of(form));
    c = in_axes(c, transposed(sh_form_axes(form)));
    for (std::size_t i = 0; i < 9; ++i) radiance.values[i * 3 + channel] = c[i];
  }
  return radiance;
}

}  // namespace welkin
