#include <welkin/envmap/reflection/brdf_spectrum.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>

// t_lq = integral over theta', phi' of (f cos+) P_lq(cos theta') cos(q phi'). About the normal the polar cosine
// runs over [0, 1] only, so the horizon costs no accuracy. About the reflected direction it runs over [-1, 1];
// there the normal lies at polar angle theta_o in the half plane of the view, and the view at 2 theta_o:
//   n = (sin theta_o, 0, cos theta_o),   v = (sin 2 theta_o, 0, cos 2 theta_o).
// The azimuth integral of a ring comes first (a cosine sum, the BRDF being even in azimuth), then the sum over rings.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int lane_count = 8;  // rings that are summed together

// Microfacet lobes get narrower across the plane of incidence in proportion to the cosine of the view;
// angular_width speaks of 60 degrees. Views are sorted into levels, each with a quadrature twice as fine as the one
// before.
constexpr int level_count = 4;

int level_of(double cos_view) { return cos_view > 0.35 ? 0 : cos_view > 0.18 ? 1 : cos_view > 0.09 ? 2 : 3; }

struct Rings {
  std::vector<double> cos_polar, weight;  // the weights hold the 2 pi of the azimuth's mean
  int samples = 0;                        // azimuths pi (k + 1/2)/samples

  // About the normal cos = s^2 with Gauss-Legendre in s on [0, 1]: dense at the horizon, where grazing lobes lie and
  // where only the azimuth needs more. About the mirrored view both do; the limit is for the time that takes.
  Rings(ReflectionFrame frame, int degree, int order, double angular_width, int level) {
    const double lobe = 8 / angular_width;
    const double finer = std::min(lobe * (1 << level), std::max(lobe, 400.0));
    const double polar = frame == ReflectionFrame::normal ? lobe : finer;
    const QuadratureRule rule = gauss_legendre(std::max(degree, static_cast<int>(polar)) + 16);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const bool half = frame == ReflectionFrame::normal;
      const double s = (1 + rule.nodes[i]) / 2;
      cos_polar.push_back(half ? s * s : rule.nodes[i]);
      weight.push_back(2 * pi * rule.weights[i] * (half ? s : 1));
    }
    samples = std::max(order, static_cast<int>(finer)) + 16;
    cos_polar.resize((weight.size() + lane_count - 1) / lane_count * lane_count, 0.0);
  }
  int count() const { return static_cast<int>(weight.size()); }
  int padded() const { return static_cast<int>(cos_polar.size()); }  // whole blocks of lane_count
};

using Colour = std::array<double, 3>;

// f cos+ for the light at (cos_polar, azimuth) of the frame.
Colour sample(const IsotropicBrdf& brdf, ReflectionFrame frame, double cos_view, double cos_polar,
              double azimuth) {
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

// One view while it is worked on.
struct View {
  bool grey = true;
  std::vector<double> orders;  // [(q * 3 + channel) * rings.padded() + ring]: azimuth integrals times weights
  std::vector<double> values;  // [pair * 3 + channel], pairs as in BrdfSpectrum
  std::array<double, 3> energy{};  // integral of the square
};

WELKIN_TARGET_CLONES void add_scaled(double weight, const double* values, double* sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] += weight * values[i];
}

// cosines[k * orders + q] = cos(q phi_k).
std::vector<double> cosine_table(int samples, int orders) {
  std::vector<double> cosines(static_cast<std::size_t>(samples) * orders);
  for (int k = 0; k < samples; ++k)
    for (int q = 0; q < orders; ++q)
      cosines[static_cast<std::size_t>(k) * orders + q] = std::cos(q * pi * (k + 0.5) / samples);
  return cosines;
}

// colours[k] of one ring; adds to the view's energy.
void sample_ring(const IsotropicBrdf& brdf, ReflectionFrame frame, double cos_view, const Rings& rings,
                 int ring, std::vector<Colour>& colours, View& view) {
  for (int k = 0; k < rings.samples; ++k) {
    const Colour f = sample(brdf, frame, cos_view, rings.cos_polar[ring], pi * (k + 0.5) / rings.samples);
    for (int c = 0; c < 3; ++c) {
      if (!(f[c] >= 0 && std::isfinite(f[c])))
        throw Error("the BRDF " + brdf.name + " has a value that is no number >= 0");
      view.energy[c] += rings.weight[ring] / rings.samples * f[c] * f[c];
    }
    view.grey = view.grey && f[0] == f[1] && f[0] == f[2];
    colours[k] = f;
  }
}

void integrate_azimuth(const IsotropicBrdf& brdf, ReflectionFrame frame, double cos_view, const Rings& rings,
                       const std::vector<double>& cosines, int orders, View& view) {
  std::vector<double> sums(orders);
  std::vector<Colour> colours(rings.samples);
  view.orders.assign(static_cast<std::size_t>(orders) * 3 * rings.padded(), 0.0);
  for (int ring = 0; ring < rings.count(); ++ring) {
    sample_ring(brdf, frame, cos_view, rings, ring, colours, view);
    const double weight = rings.weight[ring] / rings.samples;
    for (int c = 0; c < 3; ++c) {
      if (c == 0 ||
          !view.grey) {  // all rings up to here had equal channels: the last sums are those of this one too
        std::fill(sums.begin(), sums.end(), 0.0);
        for (int k = 0; k < rings.samples; ++k)
          if (colours[k][c] > 0)
            add_scaled(weight * colours[k][c], &cosines[static_cast<std::size_t>(k) * orders], sums.data(),
                       orders);
      }
      for (int q = 0; q < orders; ++q)
        view.orders[(static_cast<std::size_t>(q) * 3 + c) * rings.padded() + ring] = sums[q];
    }
  }
}

// The recurrence of basis.h in l on lane_count rings: sums[(l - q) * lane_count + lane] += P_lq(x) f for l = q ..;
// a[l - q] is its factor, `pqq` the start.
WELKIN_TARGET_CLONES void add_block(const double* x, const double* pqq, const double* f, const double* a,
                                    int degrees, double* sums) {
  double current[lane_count], previous[lane_count];
  for (int i = 0; i < lane_count; ++i) current[i] = pqq[i], previous[i] = 0;
  for (int n = 0; n < degrees; ++n) {
    if (n > 0) {
      const double back = n > 1 ? 1 / a[n - 1] : 0;
      for (int i = 0; i < lane_count; ++i) {
        const double next = a[n] * (x[i] * current[i] - back * previous[i]);
        previous[i] = current[i];
        current[i] = next;
      }
    }
    for (int i = 0; i < lane_count; ++i) sums[n * lane_count + i] += current[i] * f[i];
  }
}

void integrate_polar(const Rings& rings, int max_degree, int orders, View& view) {
  std::vector<double> pqq(rings.padded(), 0.5 / std::sqrt(pi)), a, sums;
  for (int q = 0; q < orders; ++q) {
    const int degrees = max_degree - q + 1;
    a.assign(degrees, 0.0);
    for (int l = q + 1; l <= max_degree; ++l)
      a[l - q] = std::sqrt((4.0 * l * l - 1) / (1.0 * l * l - 1.0 * q * q));
    if (q > 0)
      for (int ring = 0; ring < rings.padded(); ++ring)
        pqq[ring] *=
            std::sqrt((2.0 * q + 1) / (2.0 * q) * (1 - rings.cos_polar[ring] * rings.cos_polar[ring]));
    const std::size_t first = view.values.size();
    view.values.resize(first + 3 * static_cast<std::size_t>(degrees));
    for (int c = 0; c < (view.grey ? 1 : 3); ++c) {
      sums.assign(static_cast<std::size_t>(degrees) * lane_count, 0.0);
      const double* f = &view.orders[(static_cast<std::size_t>(q) * 3 + c) * rings.padded()];
      for (int ring = 0; ring < rings.padded(); ring += lane_count)
        add_block(&rings.cos_polar[ring], &pqq[ring], f + ring, a.data(), degrees, sums.data());
      for (int n = 0; n < degrees; ++n)
        for (int i = 0; i < lane_count; ++i) view.values[first + n * 3 + c] += sums[n * lane_count + i];
    }
    for (int n = 0; n < degrees && view.grey; ++n)
      view.values[first + n * 3 + 1] = view.values[first + n * 3 + 2] = view.values[first + n * 3];
  }
}

// [row * views + view] from what each view has, every row or every third one.
std::vector<double> gathered(const std::vector<View>& views, int channels) {
  std::vector<double> result;
  const std::size_t rows = views.front().values.size();
  result.reserve(rows / 3 * channels * views.size());
  for (std::size_t row = 0; row < rows; row += channels == 1 ? 3 : 1)
    for (const View& view : views) result.push_back(view.values[row]);
  return result;
}

}  // namespace

int brdf_degree(double angular_width, int limit) {
  const double degree = std::clamp(8 / std::max(angular_width, 1e-3), 24.0, 8e3);
  return std::min(limit, static_cast<int>(std::ceil(degree)));
}

BrdfSpectrum make_brdf_spectrum(const IsotropicBrdf& brdf, ReflectionFrame frame, int max_degree,
                                int max_order, std::span<const double> cos_views) {
  assert(max_degree >= 0 && max_order >= 0 && max_order <= max_degree && !cos_views.empty());
  if (!(brdf.angular_width >= narrowest_brdf))
    throw Error("the BRDF " + brdf.name + " is too narrow for spherical harmonics (below 0.02 rad)");
  const int orders = max_order + 1;
  std::vector<Rings> rings;
  std::vector<std::vector<double>> cosines;
  for (int level = 0; level < level_count; ++level) {
    rings.emplace_back(frame, max_degree, max_order, brdf.angular_width, level);
    cosines.push_back(cosine_table(rings.back().samples, orders));
  }
  std::vector<View> views(cos_views.size());
  parallel_for(views.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int level = level_of(cos_views[i]);
      integrate_azimuth(brdf, frame, cos_views[i], rings[level], cosines[level], orders, views[i]);
      integrate_polar(rings[level], max_degree, orders, views[i]);
      views[i].orders = {};
    }
  });

  BrdfSpectrum out;
  out.frame = frame;
  out.max_degree = max_degree;
  out.max_order = max_order;
  out.channels = std::all_of(views.begin(), views.end(), [](const View& view) { return view.grey; }) ? 1 : 3;
  out.cos_views.assign(cos_views.begin(), cos_views.end());
  for (int c = 0; c < out.channels; ++c)
    for (const View& view : views) out.total_energy.push_back(view.energy[c]);
  out.values = gathered(views, out.channels);
  return out;
}

}  // namespace welkin
