#include <welkin/sh/zh3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sh/degree2_constants.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/nonnegative_projection.h>
#include <welkin/sh/nonnegative_zonal.h>

namespace welkin {
namespace {

using namespace degree2;

// |Y_2(axis)|^2 = 5/(4 pi): the turned Y_20 is this times the sum of Y_2m(axis) Y_2m.
constexpr double turned = 1.5853309190424043;  // sqrt(4 pi / 5)

void check(const ShCoefficients& f, int least_degree) {
  if (f.max_degree < least_degree)
    throw Error(least_degree == 2 ? "ZH3 is fitted to coefficients of degree 2"
                                  : "ZH3 needs coefficients of degree 1");
  for (double v : f.values)
    if (!std::isfinite(v)) throw Error("ZH3 needs finite coefficients");
}

Nine channel(const ShCoefficients& f, int c) {
  Nine out{};
  const std::size_t count = std::min<std::size_t>(9, sh_count(f.max_degree));
  for (std::size_t i = 0; i < count; ++i) out[i] = f.values[i * f.channels + c];
  return out;
}

double zonal_part(const Nine& f, Vec3 axis) {
  const Nine y = basis9(axis.x, axis.y, axis.z);
  double sum = 0;
  for (int i = 4; i < 9; ++i) sum += f[i] * y[i];
  return turned * sum;
}

ShCoefficients degree1_of(const ShCoefficients& f) {
  ShCoefficients out(1, f.channels);
  std::copy_n(f.values.begin(), out.values.size(), out.values.begin());
  return out;
}

// The sum over the channels of zonal_part^2 grows with the step to the main axis of B = sum of zonal_part_c A_c: squares
// are convex, so the sum at any other axis is at least its tangent 2 x^T B x minus a constant, which B's main axis makes
// largest.
double ascend(const std::vector<Nine>& channels, Vec3& axis) {
  double value = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Nine sum{};
    double now = 0;
    for (const Nine& f : channels) {
      const double part = zonal_part(f, axis);
      now += part * part;
      for (int i = 4; i < 9; ++i) sum[i] -= part * f[i];
    }
    if (iteration > 0 && now <= value * (1 + 1e-15)) break;
    value = now;
    axis = minimize_on_sphere(quadric_from_sh(sum)).where;
  }
  return value;
}

// The frame of nonnegative_zonal.h for one channel.
struct Frame {
  Vec3 across;
  ZonalQuadric quadric;
};

Frame frame_of(const Nine& linear, Vec3 axis, double zonal) {
  const Vec3 b = (0.5 * y1) * Vec3{linear[3], linear[1], linear[2]};
  const double along = dot(b, axis);
  const Vec3 rest = b - along * axis;
  const double across = length(rest);
  return {across > 0 ? (1 / across) * rest : Vec3{}, {y00 * linear[0], along, across, 3 * y20 * zonal}};
}

}  // namespace

Vec3 zh3_luminance_axis(const ShCoefficients& irradiance) {
  check(irradiance, 1);
  constexpr double rec709[3] = {0.2126, 0.7152, 0.0722};
  Vec3 sum{0, 0, 0};
  for (int c = 0; c < irradiance.channels; ++c) {
    const Nine f = channel(irradiance, c);
    sum = sum + (irradiance.channels == 3 ? rec709[c] : 1.0) * Vec3{f[3], f[1], f[2]};
  }
  const double size = std::hypot(sum.x, sum.y, sum.z);
  return size > 0 ? normalized((1 / size) * sum) : Vec3{0, 0, 1};
}

Vec3 zh3_best_axis(const ShCoefficients& irradiance) {
  check(irradiance, 2);
  std::vector<Nine> channels;
  std::vector<Vec3> starts{zh3_luminance_axis(irradiance)};
  double largest = 0;
  for (double v : irradiance.values) largest = std::max(largest, std::abs(v));
  for (int c = 0; c < irradiance.channels; ++c) {
    Nine f = channel(irradiance, c);
    std::fill_n(f.begin(), 4, 0.0);
    for (double& v : f) v = largest > 0 ? v / largest : 0;
    channels.push_back(f);
    starts.emplace_back();
    minimum_degree2(f, &starts.back());
    starts.emplace_back();
    maximum_degree2(f, &starts.back());
  }
  Vec3 best = starts.front();
  double most = -1;
  for (Vec3 axis : starts) {
    const double value = ascend(channels, axis);
    if (value > most * (1 + 1e-12)) {
      most = value;
      best = axis;
    }
  }
  return best;
}

Zh3 fit_zh3(const ShCoefficients& irradiance, Vec3 axis) {
  check(irradiance, 2);
  Zh3 out{degree1_of(irradiance), axis, {}};
  for (int c = 0; c < irradiance.channels; ++c) out.zonal.push_back(zonal_part(channel(irradiance, c), axis));
  return out;
}

// In radiance, L_l = E_l / A_l with A = pi, 2 pi/3, pi/4: r = 3/2 |E_1 . axis| / E_00, and A_2 L_00 = E_00 / 4.
Zh3 hallucinate_zh3(const ShCoefficients& irradiance) {
  const Vec3 axis = zh3_luminance_axis(irradiance);
  Zh3 out{degree1_of(irradiance), axis, {}};
  for (int c = 0; c < irradiance.channels; ++c) {
    const Nine f = channel(irradiance, c);
    const double ratio = f[0] > 0 ? 1.5 * std::abs(dot(Vec3{f[3], f[1], f[2]}, axis)) / f[0] : 0;
    out.zonal.push_back(0.25 * f[0] * (0.08 * ratio + 0.6 * ratio * ratio));
  }
  return out;
}

Zh3 nonnegative_zh3(const Zh3& zh3) {
  Zh3 out = zh3;
  const ShCoefficients nine = zh3_to_sh(zh3);
  check(nine, 2);
  for (int c = 0; c < nine.channels; ++c) {
    const Nine f = channel(nine, c);
    if (!nonnegative_fit(f).changed) continue;
    double largest = 0;
    for (double v : f) largest = std::max(largest, std::abs(v));
    const int exponent = std::ilogb(largest);
    const double scale = std::ldexp(1.0, -exponent);
    Frame frame = frame_of(f, zh3.axis, zh3.zonal[c]);
    ZonalQuadric& q = frame.quadric;
    q = project_nonnegative_zonal({scale * q.c, scale * q.along, scale * q.across, scale * q.zeta});
    const Vec3 b = (2 / y1 / scale) * (q.along * zh3.axis + q.across * frame.across);
    double* linear = &out.linear.values[c];
    linear[0] = q.c / y00 / scale;
    linear[1 * nine.channels] = b.y;
    linear[2 * nine.channels] = b.z;
    linear[3 * nine.channels] = b.x;
    out.zonal[c] = q.zeta / (3 * y20) / scale;
    // The nearest function touches zero: its constant is lifted until the nine coefficients are proven.
    const NonnegativeFit proven = prove_by_lifting(channel(zh3_to_sh(out), c));
    linear[0] = proven.coefficients[0];
  }
  return out;
}

ShCoefficients zh3_to_sh(const Zh3& zh3) {
  assert(static_cast<int>(zh3.zonal.size()) == zh3.linear.channels);
  ShCoefficients out(2, zh3.linear.channels);
  std::copy(zh3.linear.values.begin(), zh3.linear.values.end(), out.values.begin());
  const Nine y = basis9(zh3.axis.x, zh3.axis.y, zh3.axis.z);
  for (int i = 4; i < 9; ++i)
    for (int c = 0; c < out.channels; ++c) out.values[i * out.channels + c] = turned * zh3.zonal[c] * y[i];
  return out;
}

void evaluate(const Zh3& zh3, Vec3 normal, std::span<double> out) {
  evaluate(zh3.linear, normal, out);
  const double cosine = dot(zh3.axis, normal), y = y20 * (3 * cosine * cosine - 1);
  for (int c = 0; c < zh3.linear.channels; ++c) out[c] += zh3.zonal[c] * y;
}

}  // namespace welkin
