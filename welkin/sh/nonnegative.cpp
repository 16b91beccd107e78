#include <welkin/sh/nonnegative.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include <welkin/error.h>
#include <welkin/sh/degree2_constants.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/nonnegative_projection.h>

namespace welkin {
namespace {

using degree2::Mat4;
using degree2::Nine;

constexpr double unit_roundoff = 0x1p-53;

// ---- Rounding

// The double next to the decimal number of nine digits that is nearest to `value`; upwards by one unit in the ninth
// place where asked.
double decimal9(double value, bool up) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 8).ptr;
  double rounded = 0;
  std::from_chars(text, end, rounded);
  if (!up || rounded >= value) return rounded;
  // One unit: 1e-8 with the exponent of the number; nine digits again, since the sum may carry.
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 8);
  return decimal9(rounded + unit, false);
}

double round_nearest(double value, CoefficientRounding rounding) {
  switch (rounding) {
    case CoefficientRounding::to_float: return static_cast<double>(static_cast<float>(value));
    case CoefficientRounding::to_digits9: return decimal9(value, false);
    default: return value;
  }
}

double round_up(double value, CoefficientRounding rounding) {
  const double nearest = round_nearest(value, rounding);
  if (nearest >= value) return nearest;
  if (rounding == CoefficientRounding::to_float)
    return std::nextafter(static_cast<float>(nearest), std::numeric_limits<float>::infinity());
  return decimal9(value, true);
}

Nine rounded(const Nine& f, CoefficientRounding rounding) {
  Nine out;
  for (int i = 0; i < 9; ++i) out[i] = round_nearest(f[i], rounding);
  return out;
}

// ---- Scale

int exponent_of(const Nine& f) {
  double largest = 0;
  for (double v : f) largest = std::max(largest, std::abs(v));
  return largest > 0 ? std::ilogb(largest) : 0;
}

Nine scaled(const Nine& f, int exponent) {
  Nine out;
  for (int i = 0; i < 9; ++i) out[i] = std::ldexp(f[i], exponent);
  return out;
}

// ---- Proof

double absolute_sum(const SphereQuadric& q) {
  return std::abs(q.xx) + std::abs(q.yy) + std::abs(q.zz) +
         2 * (std::abs(q.xy) + std::abs(q.yz) + std::abs(q.xz) + std::abs(q.b.x) + std::abs(q.b.y) +
              std::abs(q.b.z)) +
         std::abs(q.c);
}

Mat4 lemma_matrix(const SphereQuadric& q, double t) {
  return {std::array<double, 4>{q.xx + t, q.xy, q.xz, q.b.x},
          {q.xy, q.yy + t, q.yz, q.b.y},
          {q.xz, q.yz, q.zz + t, q.b.z},
          {q.b.x, q.b.y, q.b.z, q.c - t}};
}

// A bound on all rounding of proves_nonnegative. An entry of the matrix comes of at most three products with a rounded
// constant: at most 5 u of the sum of their magnitudes, which the sums below hold with room (|xx| itself may be small
// where two terms cancel, so the two are counted by 4 |zz| and 4 times the part of Y_22). A factorisation that
// succeeds is exact for a matrix at most 5 u / (1 - 5 u) times the trace away. Taking the margin off the diagonal
// rounds once more. Together below 16 u; 32 u is used.
double rounding_margin(const Nine& f, const SphereQuadric& q, double t) {
  const double hidden = 4 * (std::abs(q.zz) + degree2::y22 * std::abs(f[8]));
  return 32 * unit_roundoff * (absolute_sum(q) + hidden + 4 * std::abs(t));
}

bool is_zero(const Nine& f) {
  return std::all_of(f.begin(), f.end(), [](double v) { return v == 0; });
}

// t for a function that is proven non-negative with it; not a number where no proof is found.
double find_proof(const Nine& f, const QuadricMinimum& minimum) {
  if (is_zero(f)) return 0;
  // M - min + t J is semidefinite for t = -multiplier; the minimum itself is room, shared between both ends.
  const double t = -minimum.multiplier + 0.5 * minimum.value;
  return minimum.value >= 0 && proves_nonnegative(f, t) ? t : std::numeric_limits<double>::quiet_NaN();
}

// Raises the constant as little as the proof needs. All other coefficients are rounded already; `minimum` and
// `multiplier` (t) are those of the function as it is.
void lift_until_proven(NonnegativeFit& fit, double minimum, double multiplier, CoefficientRounding rounding) {
  const double wanted = fit.coefficients[0];
  double room = std::max(
      2.5 * rounding_margin(fit.coefficients, quadric_from_sh(fit.coefficients), multiplier), 1e-320);
  for (int attempt = 0; attempt < 60; ++attempt, room *= 2) {
    fit.coefficients[0] = round_nearest(wanted, rounding);
    const double missing = (2 * room - minimum) / degree2::y00;
    if (fit.coefficients[0] < wanted + missing) fit.coefficients[0] = round_up(wanted + missing, rounding);
    const double value = minimum + degree2::y00 * (fit.coefficients[0] - wanted);
    fit.multiplier = multiplier + 0.5 * value;
    if (proves_nonnegative(fit.coefficients, fit.multiplier)) break;
  }
}

NonnegativeFit zero_fit(double multiplier) {
  NonnegativeFit fit;
  fit.multiplier = multiplier;
  fit.changed = true;
  return fit;
}

// Rounds the projection and lifts it; `projected` is the nearest function in double precision.
NonnegativeFit finish(const Nine& projected, CoefficientRounding rounding) {
  if (is_zero(projected)) return zero_fit(0);
  NonnegativeFit fit;
  fit.changed = true;
  fit.coefficients = rounded(projected, rounding);
  fit.coefficients[0] = projected[0];
  const QuadricMinimum minimum = minimize_on_sphere(quadric_from_sh(fit.coefficients));
  lift_until_proven(fit, minimum.value, -minimum.multiplier, rounding);
  fit.lift = fit.coefficients[0] - projected[0];
  return fit;
}

// The same for doubles, with the t that the projection found: its minimum is 0 but for rounding, which a first lift
// mostly covers. The general way serves where it does not.
NonnegativeFit finish_unrounded(const Nine& projected, double multiplier) {
  NonnegativeFit fit;
  fit.changed = true;
  fit.coefficients = projected;
  const double margin = rounding_margin(projected, quadric_from_sh(projected), multiplier);
  fit.lift = 5 * margin / degree2::y00;
  fit.coefficients[0] += fit.lift;
  fit.multiplier = multiplier + 2.5 * margin;
  return proves_nonnegative(fit.coefficients, fit.multiplier) ? fit
                                                              : finish(projected, CoefficientRounding::none);
}

NonnegativeFit unchanged_or(const Nine& f, CoefficientRounding rounding, QuadricMinimum& minimum) {
  NonnegativeFit fit;
  fit.coefficients = rounded(f, rounding);
  minimum = minimize_on_sphere(quadric_from_sh(fit.coefficients));
  fit.multiplier = find_proof(fit.coefficients, minimum);
  fit.changed = std::isnan(fit.multiplier);
  return fit;
}

// ---- Degrees 0 and 1

// q = y00 f_0 + y1 v.(y, z, x) is >= 0 exactly where f_0 >= a |v|, a = y1 / y00 = sqrt(3): a circular cone. Its polar is
// f_0 <= -|v| / a; between the two the nearest point lies on the ray of slope a over v/|v|.
NonnegativeFit fit_degree1(const Nine& f, CoefficientRounding rounding) {
  QuadricMinimum minimum;
  NonnegativeFit fit = unchanged_or(f, rounding, minimum);
  if (!fit.changed) return fit;
  const int exponent = exponent_of(f);
  Nine g = scaled(f, -exponent);
  constexpr double a = degree2::y1 / degree2::y00;
  const double v = std::sqrt(g[1] * g[1] + g[2] * g[2] + g[3] * g[3]);
  if (g[0] <= -v / a) return zero_fit(0);
  if (g[0] < a * v) {
    const double onto = (a * g[0] + v) / (1 + a * a);
    g[0] = a * onto;
    for (int i = 1; i < 4; ++i) g[i] *= onto / v;
  }
  return finish(scaled(g, exponent), rounding);
}

void check(const ShCoefficients& coefficients, CoefficientRounding rounding) {
  if (coefficients.max_degree > 2)
    throw Error("the non-negative fit takes degrees 0 to 2, not " + std::to_string(coefficients.max_degree));
  for (double v : coefficients.values) {
    if (!std::isfinite(v)) throw Error("the non-negative fit needs finite coefficients");
    if (rounding == CoefficientRounding::to_float && std::abs(v) > 1e38)
      throw Error("coefficients beyond 1e38 do not fit into float");
  }
}

}  // namespace

bool proves_nonnegative(std::span<const double, 9> coefficients, double multiplier) {
  Nine f;
  std::copy(coefficients.begin(), coefficients.end(), f.begin());
  if (is_zero(f) && multiplier == 0) return true;
  const int exponent = exponent_of(f);
  const double t = std::ldexp(multiplier, -exponent);
  f = scaled(f, -exponent);  // exact, or off by less than 1e-300
  const SphereQuadric quadric = quadric_from_sh(f);
  return std::isfinite(t) && degree2::has_cholesky(lemma_matrix(quadric, t), -rounding_margin(f, quadric, t));
}

NonnegativeFit nonnegative_fit(std::span<const double, 9> coefficients, CoefficientRounding rounding) {
  Nine f;
  std::copy(coefficients.begin(), coefficients.end(), f.begin());
  QuadricMinimum minimum;
  NonnegativeFit fit = unchanged_or(f, rounding, minimum);
  if (!fit.changed) return fit;
  const bool as_it_is = rounding == CoefficientRounding::none;
  if (!as_it_is) minimum = minimize_on_sphere(quadric_from_sh(f));
  if (minimum.value >= 0) return finish(f, rounding);  // only the proof lacks room, or the rounding took it
  const int exponent = exponent_of(f);
  minimum.value = std::ldexp(minimum.value, -exponent);
  minimum.multiplier = std::ldexp(minimum.multiplier, -exponent);
  const degree2::NearestNonnegative nearest = degree2::project_nonnegative(scaled(f, -exponent), minimum);
  const Nine projected = scaled(nearest.coefficients, exponent);
  fit = as_it_is && !is_zero(projected)
            ? finish_unrounded(projected, std::ldexp(nearest.multiplier, exponent))
            : finish(projected, rounding);
  fit.iterations = nearest.iterations;
  fit.converged = nearest.converged;
  return fit;
}

NonnegativeFit degree2::prove_by_lifting(const Nine& coefficients) {
  return finish(coefficients, CoefficientRounding::none);
}

ShCoefficients nonnegative_fit(const ShCoefficients& coefficients, CoefficientRounding rounding,
                               std::vector<NonnegativeFit>* fits) {
  check(coefficients, rounding);
  ShCoefficients out = coefficients;
  if (fits) fits->clear();
  const int channels = coefficients.channels, count = static_cast<int>(sh_count(coefficients.max_degree));
  for (int c = 0; c < channels; ++c) {
    Nine f{};
    for (int i = 0; i < count; ++i) f[i] = coefficients.values[static_cast<std::size_t>(i) * channels + c];
    const NonnegativeFit fit =
        coefficients.max_degree == 2 ? nonnegative_fit(f, rounding) : fit_degree1(f, rounding);
    for (int i = 0; i < count; ++i)
      out.values[static_cast<std::size_t>(i) * channels + c] = fit.coefficients[i];
    if (fits) fits->push_back(fit);
  }
  return out;
}

}  // namespace welkin
