#include <welkin/envmap/reflection/brdf_spectrum.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>

// t_lq = integral over theta', phi' of (f cos+) P_lq(cos theta') cos(q phi'). About the normal the polar cosine runs over
// [0, 1] only, so the horizon costs no accuracy. About the reflected direction it runs over [-1, 1]; there the normal
// lies at polar angle theta_o in the half plane of the view, and the view at 2 theta_o:
//   n = (sin theta_o, 0, cos theta_o),   v = (sin 2 theta_o, 0, cos 2 theta_o).
// The azimuth integral of a ring comes first (a cosine sum, the BRDF being even in azimuth), then the sum over rings.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

struct Rings {
  std::vector<double> cos_polar, weight;  // the weights hold the 2 pi of the azimuth's mean
  int samples = 0;                        // azimuths pi (k + 1/2)/samples

  Rings(ReflectionFrame frame, int degree, int order, double angular_width) {
    const int lobe = static_cast<int>(std::ceil(8 / std::max(angular_width, narrowest_brdf)));
    const QuadratureRule rule = gauss_legendre(std::max(degree, lobe) + 16);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const bool half = frame == ReflectionFrame::normal;
      cos_polar.push_back(half ? (1 + rule.nodes[i]) / 2 : rule.nodes[i]);
      weight.push_back(2 * pi * (half ? rule.weights[i] / 2 : rule.weights[i]));
    }
    samples = std::max(order, lobe) + 16;
  }
  int count() const { return static_cast<int>(cos_polar.size()); }
};

using Colour = std::array<double, 3>;

// f cos+ for the light at (cos_polar, azimuth) of the frame.
Colour sample(const IsotropicBrdf& brdf, ReflectionFrame frame, double cos_view, double cos_polar, double azimuth) {
  if (frame == ReflectionFrame::normal) {
    Colour f = brdf.value(cos_polar, cos_view, azimuth);
    for (double& value : f) value *= cos_polar;
    return f;
  }
  const double sin_view = std::sqrt(std::max(0.0, 1 - cos_view * cos_view));
  const double sin_polar = std::sqrt(std::max(0.0, 1 - cos_polar * cos_polar));
  const double x = sin_polar * std::cos(azimuth), y = sin_polar * std::sin(azimuth);
  const double cos_light = std::min(1.0, sin_view * x + cos_view * cos_polar);
  if (cos_light <= 0) return {};
  // The axis normal to n towards v is (cos theta_o, 0, -sin theta_o).
  const double along = cos_view * x - sin_view * cos_polar;
  Colour f = brdf.value(cos_light, cos_view, std::atan2(std::abs(y), along));
  for (double& value : f) value *= cos_light;
  return f;
}

// One view: values[(ring * samples + k) * 3 + channel].
std::vector<double> sample_view(const IsotropicBrdf& brdf, ReflectionFrame frame, double cos_view, const Rings& rings) {
  std::vector<double> values(static_cast<std::size_t>(rings.count()) * rings.samples * 3);
  for (int ring = 0; ring < rings.count(); ++ring) {
    for (int k = 0; k < rings.samples; ++k) {
      const Colour f = sample(brdf, frame, cos_view, rings.cos_polar[ring], pi * (k + 0.5) / rings.samples);
      for (int c = 0; c < 3; ++c) {
        if (!(f[c] >= 0 && std::isfinite(f[c]))) throw Error("the BRDF " + brdf.name + " has a value that is no number >= 0");
        values[(static_cast<std::size_t>(ring) * rings.samples + k) * 3 + c] = f[c];
      }
    }
  }
  return values;
}

bool is_grey(const std::vector<std::vector<double>>& samples) {
  for (const auto& view : samples)
    for (std::size_t i = 0; i < view.size(); i += 3)
      if (view[i] != view[i + 1] || view[i] != view[i + 2]) return false;
  return true;
}

WELKIN_TARGET_CLONES void add_scaled(double weight, const double* values, double* sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] += weight * values[i];
}

// The mean over azimuth of a ring times cos(q phi), q = 0 .. max_order: out[q].
void ring_orders(const double* ring, int channel, const std::vector<double>& cosines, int samples,
                 std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  for (int k = 0; k < samples; ++k) {
    const double value = ring[k * 3 + channel];
    if (value != 0)
      add_scaled(value / samples, &cosines[static_cast<std::size_t>(k) * out.size()], out.data(),
                 static_cast<int>(out.size()));
  }
}

// orders[((q * channels + channel) * rings + ring) * views + view]
using Orders = std::vector<double>;

Orders azimuth_integrals(const std::vector<std::vector<double>>& samples, const Rings& rings, const BrdfSpectrum& shape) {
  const int orders = shape.max_order + 1, views = shape.views();
  std::vector<double> cosines(static_cast<std::size_t>(rings.samples) * orders);
  for (int k = 0; k < rings.samples; ++k)
    for (int q = 0; q < orders; ++q)
      cosines[static_cast<std::size_t>(k) * orders + q] = std::cos(q * pi * (k + 0.5) / rings.samples);
  Orders result(static_cast<std::size_t>(orders) * shape.channels * rings.count() * views);
  parallel_for(rings.count(), 4, [&](std::size_t begin, std::size_t end) {
    std::vector<double> out(orders);
    for (std::size_t ring = begin; ring < end; ++ring) {
      for (int view = 0; view < views; ++view) {
        for (int c = 0; c < shape.channels; ++c) {
          ring_orders(&samples[view][ring * rings.samples * 3], c, cosines, rings.samples, out);
          for (int q = 0; q < orders; ++q)
            result[((static_cast<std::size_t>(q) * shape.channels + c) * rings.count() + ring) * views + view] = out[q];
        }
      }
    }
  });
  return result;
}

// P_qq of the ring, then upwards in l by the recurrence of basis.h.
void sum_rings(int q, const Rings& rings, const Orders& orders, BrdfSpectrum& out) {
  const int views = out.views();
  for (int ring = 0; ring < rings.count(); ++ring) {
    const double x = rings.cos_polar[ring], sine = std::sqrt(1 - x * x);
    double current = 0.5 / std::sqrt(pi), previous = 0, last_a = 0;
    for (int m = 1; m <= q; ++m) current *= std::sqrt((2.0 * m + 1) / (2.0 * m)) * sine;
    for (int l = q; l <= out.max_degree; ++l) {
      if (l > q) {
        const double a = std::sqrt((4.0 * l * l - 1) / (1.0 * l * l - 1.0 * q * q));
        const double next = a * (x * current - (l > q + 1 ? previous / last_a : 0));
        previous = current;
        current = next;
        last_a = a;
      }
      for (int c = 0; c < out.channels; ++c) {
        const std::size_t from = ((static_cast<std::size_t>(q) * out.channels + c) * rings.count() + ring) * views;
        add_scaled(rings.weight[ring] * current, &orders[from], out.at(l, q, c), views);
      }
    }
  }
}

double energy_of(const std::vector<double>& view, const Rings& rings, int channel) {
  double sum = 0;
  for (int ring = 0; ring < rings.count(); ++ring)
    for (int k = 0; k < rings.samples; ++k) {
      const double value = view[(static_cast<std::size_t>(ring) * rings.samples + k) * 3 + channel];
      sum += rings.weight[ring] / rings.samples * value * value;
    }
  return sum;
}

}  // namespace

int brdf_degree(double angular_width, int limit) {
  const double degree = std::clamp(8 / std::max(angular_width, 1e-3), 24.0, 8e3);
  return std::min(limit, static_cast<int>(std::ceil(degree)));
}

BrdfSpectrum make_brdf_spectrum(const IsotropicBrdf& brdf, ReflectionFrame frame, int max_degree, int max_order,
                                std::span<const double> cos_views) {
  assert(max_degree >= 0 && max_order >= 0 && max_order <= max_degree);
  if (!(brdf.angular_width >= narrowest_brdf))
    throw Error("the BRDF " + brdf.name + " is too narrow for spherical harmonics (below 0.02 rad)");
  const Rings rings(frame, max_degree, max_order, brdf.angular_width);
  std::vector<std::vector<double>> samples(cos_views.size());
  parallel_for(cos_views.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t view = begin; view < end; ++view)
      samples[view] = sample_view(brdf, frame, cos_views[view], rings);
  });

  BrdfSpectrum out;
  out.frame = frame;
  out.max_degree = max_degree;
  out.max_order = max_order;
  out.channels = is_grey(samples) ? 1 : 3;
  out.cos_views.assign(cos_views.begin(), cos_views.end());
  for (int c = 0; c < out.channels; ++c)
    for (const auto& view : samples) out.total_energy.push_back(energy_of(view, rings, c));
  const auto pairs = static_cast<std::size_t>(max_order + 1) * static_cast<std::size_t>(2 * max_degree + 2 - max_order) / 2;
  out.values.resize(pairs * out.channels * cos_views.size());
  const Orders orders = azimuth_integrals(samples, rings, out);
  parallel_for(max_order + 1, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) sum_rings(static_cast<int>(q), rings, orders, out);
  });
  return out;
}

}  // namespace welkin
