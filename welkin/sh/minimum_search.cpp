#include <welkin/sh/minimum_search.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/ring_transform.h>
#include <welkin/sh/rotation.h>

// Newton's method needs two derivatives. After a rotation that takes the point to the pole only the orders 0, +-1, +-2
// have them: with t = theta (cos phi, sin phi), K = sqrt((2l+1)/(4 pi)) and L = l(l+1), to second order
//   Y_l0  = K (1 - L |t|^2/4)
//   Y_l1  = K sqrt(L/2) t_x,                     Y_l-1 with t_y
//   Y_l2  = K sqrt(L (L - 2)/32) (t_x^2 - t_y^2), Y_l-2 with 2 t_x t_y.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// value + gradient . t + (xx t_x^2 + 2 xy t_x t_y + yy t_y^2)/2 near a point.
struct Expansion {
  double value = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

// Rows: two tangents and the point itself, right-handed; takes the point to the pole.
Mat3 frame_at(Vec3 point) {
  const Vec3 aside = std::abs(point.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 first = normalized(cross(aside, point));
  return {{first, cross(point, first), point}};
}

Expansion expand(const ShCoefficients& f, const Mat3& frame) {
  const ShCoefficients at_pole = rotate(f, frame);
  Expansion e;
  for (int l = 0; l <= f.max_degree; ++l) {
    const double k = std::sqrt((2 * l + 1) / (4 * pi)), ll = l * (l + 1.0);
    const auto c = [&](int m) { return k * at_pole.values[sh_index(l, m)]; };
    e.value += c(0);
    if (l == 0) continue;
    e.x += std::sqrt(ll / 2) * c(1);
    e.y += std::sqrt(ll / 2) * c(-1);
    const double bend = -ll / 2 * c(0), shear = l < 2 ? 0 : 2 * std::sqrt(ll * (ll - 2) / 32);
    e.xx += bend + (l < 2 ? 0 : shear * c(2));
    e.yy += bend - (l < 2 ? 0 : shear * c(2));
    e.xy += l < 2 ? 0 : shear * c(-2);
  }
  return e;
}

struct Step {
  double x = 0, y = 0;
};

// Newton's step with the absolute values of the Hessian's eigenvalues, so that it always goes down, at most `longest`.
Step newton_step(const Expansion& e, double longest) {
  const double mean = (e.xx + e.yy) / 2, half = (e.xx - e.yy) / 2, radius = std::hypot(half, e.xy);
  const double angle = std::atan2(e.xy, half) / 2, cosine = std::cos(angle), sine = std::sin(angle);
  const double floor = 1e-6 * (std::abs(mean) + radius) + 1e-300;
  const double along = -(e.x * cosine + e.y * sine) / std::max(std::abs(mean + radius), floor);
  const double across = -(-e.x * sine + e.y * cosine) / std::max(std::abs(mean - radius), floor);
  const double scale = std::min(1.0, longest / (std::hypot(along, across) + 1e-300));
  return {scale * (along * cosine - across * sine), scale * (along * sine + across * cosine)};
}

Vec3 walk(const Mat3& frame, Step step) {
  const double angle = std::hypot(step.x, step.y), ratio = angle > 0 ? std::sin(angle) / angle : 1;
  return normalized(ratio * (step.x * frame.rows[0] + step.y * frame.rows[1]) +
                    std::cos(angle) * frame.rows[2]);
}

SphereMinimum descend(const ShCoefficients& f, Vec3 start) {
  Mat3 frame = frame_at(start);
  Expansion here = expand(f, frame);
  const double longest = 0.5 / f.max_degree;
  for (int i = 0; i < 40; ++i) {
    Step step = newton_step(here, longest);
    bool lower = false;
    for (int halving = 0; halving < 6 && !lower; ++halving) {
      const Mat3 there = frame_at(walk(frame, step));
      const Expansion e = expand(f, there);
      lower = e.value < here.value;
      if (lower) frame = there, here = e;
      step = {step.x / 2, step.y / 2};
    }
    if (!lower) break;
  }
  return {here.value, frame.rows[2]};
}

std::vector<SphereMinimum> sample(const ShCoefficients& f) {
  const int rings = static_cast<int>(std::ceil(4.5 * f.max_degree)), azimuths = 2 * rings;
  RingTransform ring(f.max_degree, azimuths);
  std::vector<SphereMinimum> samples;
  std::vector<double> values;
  for (int i = 0; i < rings; ++i) {
    const double theta = pi * (i + 0.5) / rings, z = std::cos(theta), r = std::sin(theta);
    ring.set_ring(z);
    ring.synthesize(f, values);
    for (int k = 0; k < azimuths; ++k)
      samples.push_back({values[k], {r * ring.cosine(k), r * ring.sine(k), z}});
  }
  return samples;
}

ShCoefficients one_channel(const ShCoefficients& all, int channel) {
  ShCoefficients one(all.max_degree, 1);
  for (std::size_t i = 0; i < one.values.size(); ++i) one.values[i] = all.values[i * all.channels + channel];
  return one;
}

void check(const ShCoefficients& function, int channel) {
  check_coefficients(function);
  if (function.max_degree > max_minimum_search_degree)
    throw Error("the minimum is searched up to degree " + std::to_string(max_minimum_search_degree) +
                ", not " + std::to_string(function.max_degree));
  if (channel < 0 || channel >= function.channels)
    throw Error("there is no channel " + std::to_string(channel));
  for (double value : function.values)
    if (!std::isfinite(value)) throw Error("the coefficients are not all finite");
}

}  // namespace

SphereMinimum find_minimum(const ShCoefficients& function, int channel) {
  check(function, channel);
  const ShCoefficients f = one_channel(function, channel);
  if (f.max_degree == 0) return {f.values[0] / std::sqrt(4 * pi), {0, 0, 1}};
  std::vector<SphereMinimum> samples = sample(f);
  const auto by_value = [](const SphereMinimum& a, const SphereMinimum& b) { return a.value < b.value; };
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end(), by_value);
  const double limit = low->value + 0.07 * (high->value - low->value);
  std::erase_if(samples, [&](const SphereMinimum& s) { return s.value > limit; });
  std::sort(samples.begin(), samples.end(), by_value);
  const double near = std::cos(0.5 / f.max_degree);
  std::vector<SphereMinimum> found;
  for (const SphereMinimum& s : samples) {
    const bool known = std::any_of(found.begin(), found.end(),
                                   [&](const SphereMinimum& m) { return dot(m.where, s.where) > near; });
    if (!known) found.push_back(descend(f, s.where));
  }
  return *std::min_element(found.begin(), found.end(), by_value);
}

}  // namespace welkin
