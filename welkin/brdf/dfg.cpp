#include <welkin/brdf/dfg.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>

// The integral over lights, rewritten over microfacet normals h (d light = 4 (v.h) dh), with Schlick's
// F = F0 + (1 - F0) c, c = (1 - v.h)^5:
//   scale = A - C, bias = C, (A, C) = integral of (1, c) (G2 / cos_view) (v.h) D(h) dh over v.h > 0, light.z
//   > 0.
// With h = (sin t_h cos p, sin t_h sin p, cos t_h), v in the plane p = 0, and tan t_h = alpha sinh t, GGX
// becomes
//   D(h) cos t_h dh = d(tanh^2 t) dp / 2pi:
// the variable t resolves the peak (t near 1 whatever alpha is) and, logarithmically, the long tail.
//
// The light is above the surface where light.z = 2 (v.h) cos t_h - cos_view > 0, that is
//   cos p > -cot t_v cot 2 t_h.
// So with t_v the view's angle there are two panels in t: below t_h = (pi/2 - t_v) / 2 =: a every p counts,
// the integrand is a smooth periodic function of p, and the midpoint rule converges exponentially; from a to
// b = (pi/2 + t_v) / 2 only |p| < p_max counts, where p_max behaves like a square root at both ends. Inside
// these exact limits everything is smooth, so Gauss-Legendre in p, and in t after a substitution that removes
// the roots, converges fast too. Note tan a = cos_view / (1 + sin t_v) and tan b = 1 / tan a.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int ring_nodes = 16;      // in t, per panel
constexpr int azimuth_nodes = 12;   // in p, over half the circle (the integrand is even)
constexpr double panel_length = 3;  // in t; longer ranges are cut in two
constexpr double tail_end = 14;     // what lies beyond is less than 2e-6 of the whole

// The inner loops are in float (relative rounding 1e-6, far below the rule's own error): twice the lanes.
using Azimuths = std::array<float, azimuth_nodes>;

struct Rules {
  std::array<double, ring_nodes> ring_x, ring_weight;  // Gauss-Legendre on [0, 1]
  Azimuths azimuth_x, azimuth_weight;                  // upper half of Gauss-Legendre on [-1, 1]
  Azimuths full_cosine, full_weight;                   // midpoint rule on [0, pi], weights of the mean
};

const Rules& rules() {
  static const Rules shared = [] {
    Rules r;
    const QuadratureRule ring = gauss_legendre(ring_nodes);
    for (int i = 0; i < ring_nodes; ++i) {
      r.ring_x[i] = (1 + ring.nodes[i]) / 2;
      r.ring_weight[i] = ring.weights[i] / 2;
    }
    const QuadratureRule azimuth = gauss_legendre(2 * azimuth_nodes);
    for (int i = 0; i < azimuth_nodes; ++i) {
      r.azimuth_x[i] = static_cast<float>(azimuth.nodes[azimuth_nodes + i]);
      r.azimuth_weight[i] = static_cast<float>(azimuth.weights[azimuth_nodes + i]);
      r.full_cosine[i] = static_cast<float>(std::cos((i + 0.5) * pi / azimuth_nodes));
      r.full_weight[i] = 1.0f / azimuth_nodes;
    }
    return r;
  }();
  return shared;
}

// cos x for x in [0, pi] to float's rounding, as 1 - 2 sin^2 (x/2): a polynomial, so that loops over nodes
// vectorise.
inline float cosine(float x) {
  const float h = x / 2, h2 = h * h;
  float s = -1.0f / 39916800;
  s = s * h2 + 1.0f / 362880;
  s = s * h2 - 1.0f / 5040;
  s = s * h2 + 1.0f / 120;
  s = s * h2 - 1.0f / 6;
  s = h + h * h2 * s;
  return 1 - 2 * s * s;
}

struct View {
  double alpha, alpha2, cos_view, sin_view, s_view;  // s_view = sqrt(alpha^2 + (1 - alpha^2) cos_view^2)
};

struct Sums {
  double all = 0, schlick = 0;  // A and C
};

// The weighted mean over p of (G2 / cos_view) (v.h) (1, c) for one t_h. With S as in ggx.cpp,
// G2 / cos_view = 2 l / (cos_view S(l) + l S(view)), finite at cos_view = 0.
Sums ring_mean(const View& view, double cos_h, double sin_h, const Azimuths& cos_azimuth,
               const Azimuths& weight) {
  const float along = static_cast<float>(view.cos_view * cos_h),
              across = static_cast<float>(view.sin_view * sin_h);
  const float twice_cos_h = static_cast<float>(2 * cos_h), cos_view = static_cast<float>(view.cos_view);
  const float alpha2 = static_cast<float>(view.alpha2), rest = static_cast<float>(1 - view.alpha2);
  const float s_view = static_cast<float>(view.s_view);
  Azimuths all, schlick;
  for (int i = 0; i < azimuth_nodes; ++i) {
    const float view_half = along + across * cos_azimuth[i];
    const float raw = view_half * twice_cos_h - cos_view;
    const float light = raw > 0 ? raw : 0;  // rounding at the limits
    const float s_light = std::sqrt(alpha2 + rest * light * light);
    const float value = weight[i] * view_half * 2 * light / (cos_view * s_light + light * s_view);
    const float x = 1 - view_half, x2 = x * x;
    all[i] = value;
    schlick[i] = value * x2 * x2 * x;
  }
  Sums sums;
  for (int i = 0; i < azimuth_nodes; ++i) {
    sums.all += all[i];
    sums.schlick += schlick[i];
  }
  return sums;
}

// Adds the ring at `t`, where every p counts (whole_circle) or only those up to p_max.
void add_ring(const Rules& rule, const View& view, double t, double t_weight, bool whole_circle,
              Sums& total) {
  const double grown = std::exp(t);
  const double sinh = (grown - 1 / grown) / 2, cosh = (grown + 1 / grown) / 2;
  const double tan_h = view.alpha * sinh;
  const double cos_h = 1 / std::sqrt(1 + tan_h * tan_h), sin_h = tan_h * cos_h;
  double scale = t_weight * 2 * sinh / (cosh * cosh * cosh * cos_h);  // d(tanh^2 t) / cos t_h
  Sums ring;
  if (whole_circle) {
    ring = ring_mean(view, cos_h, sin_h, rule.full_cosine, rule.full_weight);
  } else {
    const double limit =
        view.cos_view * (sin_h * sin_h - cos_h * cos_h) / (2 * sin_h * cos_h * view.sin_view);
    const double p_max = std::acos(std::clamp(limit, -1.0, 1.0));
    Azimuths cosines;
    for (int i = 0; i < azimuth_nodes; ++i)
      cosines[i] = cosine(static_cast<float>(p_max) * rule.azimuth_x[i]);
    ring = ring_mean(view, cos_h, sin_h, cosines, rule.azimuth_weight);
    scale *= p_max / pi;
  }
  total.all += scale * ring.all;
  total.schlick += scale * ring.schlick;
}

// Where the integrand behaves like a square root of the distance to an end of the panel.
enum class Root { none, begin, end, both };

void add_panel(const View& view, double begin, double end, Root root, bool whole_circle, Sums& total) {
  const double length = end - begin;
  if (!(length > 0)) return;
  const Rules& rule = rules();
  for (int i = 0; i < ring_nodes; ++i) {
    const double x = rule.ring_x[i];
    double where = x, slope = 1;
    if (root == Root::begin) {
      where = x * x;
      slope = 2 * x;
    } else if (root == Root::end) {
      where = 1 - (1 - x) * (1 - x);
      slope = 2 * (1 - x);
    } else if (root == Root::both) {
      const double s = std::sin(pi / 2 * x);
      where = s * s;
      slope = pi * s * std::cos(pi / 2 * x);
    }
    add_ring(rule, view, begin + length * where, rule.ring_weight[i] * length * slope, whole_circle, total);
  }
}

}  // namespace

DfgValue integrate_dfg(double cos_view, double alpha) {
  assert(cos_view >= 0 && cos_view <= 1 && alpha >= 0 && alpha <= 1);
  if (alpha < 1e-9) {
    const double schlick = std::pow(1 - cos_view, 5);
    return {1 - schlick, schlick};
  }
  const double alpha2 = alpha * alpha;
  const View view{alpha, alpha2, cos_view, std::sqrt((1 - cos_view) * (1 + cos_view)),
                  std::sqrt(alpha2 + (1 - alpha2) * cos_view * cos_view)};
  const double tan_a = cos_view / (1 + view.sin_view);
  const double a = std::min(std::asinh(tan_a / alpha), tail_end);
  const double b = tan_a > 0 ? std::asinh(1 / (tan_a * alpha)) : 2 * tail_end;
  const bool long_tail = b > tail_end;
  const double last = std::min(b, tail_end);
  constexpr double cut_above = 1.3 * panel_length;

  Sums sums;
  const double cut = a > cut_above ? panel_length : 0;
  add_panel(view, 0, cut, Root::none, true, sums);
  add_panel(view, cut, a, Root::none, true, sums);
  if (last - a < cut_above) {
    add_panel(view, a, last, long_tail ? Root::begin : Root::both, false, sums);
  } else {
    add_panel(view, a, a + panel_length, Root::begin, false, sums);
    add_panel(view, a + panel_length, last, long_tail ? Root::none : Root::end, false, sums);
  }
  return {sums.all - sums.schlick, sums.schlick};
}

// With c = x^3 the nodes crowd at grazing angles, where E_ss changes over a distance of alpha.
double average_albedo(double alpha) {
  static const QuadratureRule rule = gauss_legendre(48);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = (1 + rule.nodes[i]) / 2;
    const double c = x * x * x;
    sum += rule.weights[i] / 2 * 3 * x * x * 2 * c * integrate_dfg(c, alpha).albedo();
  }
  return sum;
}

double multiple_scattering_factor(double f0, double albedo) { return 1 + f0 * (1 / albedo - 1); }

double multiple_scattering_lobe(double albedo_view, double albedo_light, double average) {
  return average < 1 ? (1 - albedo_view) * (1 - albedo_light) / (pi * (1 - average)) : 0;
}

namespace {

DfgValue with_multiple_scattering(DfgValue single) {
  constexpr double low = 0.04;
  const double at_low = (low * single.scale + single.bias) * multiple_scattering_factor(low, single.albedo());
  const double scale = (1 - at_low) / (1 - low);  // at F0 = 1 the compensated reflectance is 1
  return {scale, 1 - scale};
}

}  // namespace

DfgTable make_dfg_table(const DfgOptions& options) {
  if (options.size < 1 || options.size > 4096)
    throw Error("DFG table size " + std::to_string(options.size) + " is out of range: use 1 to 4096");
  const std::size_t size = static_cast<std::size_t>(options.size);
  DfgTable table{options.size, std::vector<float>(2 * size * size)};
  parallel_for(size * size, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double cos_view = (static_cast<double>(i % size) + 0.5) / static_cast<double>(size);
      const double perceptual_roughness = (static_cast<double>(i / size) + 0.5) / static_cast<double>(size);
      DfgValue value = integrate_dfg(cos_view, perceptual_roughness * perceptual_roughness);
      if (options.form == DfgForm::scale_bias_with_multiple_scattering)
        value = with_multiple_scattering(value);
      table.scale_bias[2 * i] = static_cast<float>(value.scale);
      table.scale_bias[2 * i + 1] = static_cast<float>(value.bias);
    }
  });
  return table;
}

DfgValue look_up_dfg(const DfgTable& table, double cos_view, double perceptual_roughness) {
  assert(table.size > 0);
  struct Tap {
    int first, second;
    double t;
  };
  const auto tap = [&](double coordinate) {
    const double x = std::clamp(coordinate * table.size - 0.5, 0.0, table.size - 1.0);
    const int first = static_cast<int>(x);
    return Tap{first, std::min(first + 1, table.size - 1), x - first};
  };
  const Tap x = tap(cos_view), y = tap(perceptual_roughness);
  const auto channel = [&](int c) {
    const auto at = [&](int i, int j) {
      return static_cast<double>(table.scale_bias[2 * (static_cast<std::size_t>(j) * table.size + i) + c]);
    };
    const double upper = (1 - x.t) * at(x.first, y.first) + x.t * at(x.second, y.first);
    const double lower = (1 - x.t) * at(x.first, y.second) + x.t * at(x.second, y.second);
    return (1 - y.t) * upper + y.t * lower;
  };
  return {channel(0), channel(1)};
}

}  // namespace welkin
