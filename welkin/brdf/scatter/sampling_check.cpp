#include <welkin/brdf/scatter/sampling_check.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <welkin/error.h>
#include <welkin/geometry/frame.h>
#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int sectors = 12, ring_nodes = 12, sector_nodes = 12;

bool is_axial(ScatterModel model) {
  return model == ScatterModel::phong || model == ScatterModel::blinn_phong ||
         model == ScatterModel::lafortune;
}

// Where the BRDF is greatest, about.
Vec3f lobe_axis(const Scatter& s, Vec3f view) {
  if (s.model == ScatterModel::lambert || s.model == ScatterModel::oren_nayar) return {0, 0, 1};
  if (s.model != ScatterModel::lafortune) return {-view.x, -view.y, view.z};
  const Vec3f axis{s.lafortune_c[0] * view.x, s.lafortune_c[1] * view.y, s.lafortune_c[2] * view.z};
  return axis.z > 0 ? normalized(axis) : Vec3f{0, 0, 1};
}

double lobe_width(const Scatter& s) {
  if (s.model == ScatterModel::lambert || s.model == ScatterModel::oren_nayar) return 1;
  if (is_axial(s.model)) return 1 / std::sqrt(1.0 + s.exponent);
  const double alpha = s.model == ScatterModel::coated_diffuse ? s.alpha_x : std::min(s.alpha_x, s.alpha_y);
  return alpha > 0 ? std::max(1e-3, alpha) : 1;
}

// Directions at the angle rho from an axis, at the azimuth psi from the way up: above the horizon for |psi| < end(rho).
struct Polar {
  Vec3f axis, up, across;
  double cosine = 1, sine = 0;  // of the axis from the normal

  explicit Polar(Vec3f unit_axis) : axis(unit_axis) {
    const double flat = std::hypot(axis.x, axis.y);
    cosine = axis.z;
    sine = flat;
    const LocalFrame frame = make_frame(axis, {0, 0, 1});
    up = flat > 1e-6 ? frame.tangent : make_frame(axis).tangent;
    across = cross(axis, up);
  }
  double end(double rho) const {
    const double level = std::cos(rho) * cosine, swing = std::sin(rho) * sine;
    if (level >= swing) return pi;
    return level <= -swing ? 0 : std::acos(-level / swing);
  }
  Vec3f direction(double rho, double psi) const {
    const double s = std::sin(rho);
    return static_cast<float>(std::cos(rho)) * axis + static_cast<float>(s * std::cos(psi)) * up +
           static_cast<float>(s * std::sin(psi)) * across;
  }
};

// Ring edges: a quarter of the lobe's width (narrowed by foreshortening), doubling; and where the horizon is met and left.
std::vector<double> ring_edges(const Polar& polar, double width) {
  const double meets = std::acos(std::clamp(polar.sine, 0.0, 1.0)), leaves = pi - meets;
  std::vector<double> edges{0, meets, leaves};
  if (pi / 2 > meets + 1e-3 && pi / 2 < leaves - 1e-3) edges.push_back(pi / 2);  // cos^N ends there
  for (double rho = width * std::clamp(polar.cosine, 0.05, 1.0) / 4; rho < leaves; rho *= 2)
    if (std::abs(rho - meets) > 0.1 * rho && std::abs(rho - pi / 2) > 0.2 && rho < 0.95 * leaves)
      edges.push_back(rho);
  std::sort(edges.begin(), edges.end());
  while (edges.size() > 2 && edges.back() - edges[edges.size() - 2] < 1e-9) edges.pop_back();
  return edges;
}

// Adds up value and pdf bin by bin. Nodes crowd at both ends of a ring like sin^2, for the roots of end(rho) there.
struct Integrals {
  double value[3] = {}, pdf = 0;
};

Integrals integrate(const Scatter& s, Vec3f view, const Polar& polar, const std::vector<double>& edges,
                    std::vector<double>& bins) {
  static const QuadratureRule ring = gauss_legendre(ring_nodes), sector = gauss_legendre(sector_nodes);
  Integrals total;
  for (std::size_t r = 0; r + 1 < edges.size(); ++r)
    for (int i = 0; i < ring_nodes; ++i) {
      const double x = pi / 4 * (1 + ring.nodes[i]), root = std::sin(x), length = edges[r + 1] - edges[r];
      const double rho = edges[r] + length * root * root, end = polar.end(rho);
      const double weight = ring.weights[i] * pi / 4 * 2 * root * std::cos(x) * length * std::sin(rho);
      for (int j = 0; j < sectors * sector_nodes; ++j) {
        const double t = (j / sector_nodes + (1 + sector.nodes[j % sector_nodes]) / 2) / sectors;
        const double w = weight * sector.weights[j % sector_nodes] / sectors * end;
        const ScatterValue v = evaluate_with_pdf(s, polar.direction(rho, (2 * t - 1) * end), view);
        bins[r * sectors + j / sector_nodes] += w * v.pdf;
        total.pdf += w * v.pdf;
        total.value[0] += w * v.value.r;
        total.value[1] += w * v.value.g;
        total.value[2] += w * v.value.b;
      }
    }
  return total;
}

std::size_t bin_of(const Polar& polar, const std::vector<double>& edges, Vec3f light) {
  const double rho = 2 * std::asin(std::min(1.0, length(light - polar.axis) / 2.0));
  const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, rho);
  const double psi = std::atan2(dot(light, polar.across), dot(light, polar.up)), end = polar.end(rho);
  const double t = end > 0 ? (psi / end + 1) / 2 : 0;
  const int sector = std::clamp(static_cast<int>(t * sectors), 0, sectors - 1);
  return static_cast<std::size_t>(above - edges.begin() - 1) * sectors + sector;
}

// Wilson & Hilferty 1931: the cube root of chi-square over its degrees of freedom is nearly normal.
double chi_square_p(const std::vector<double>& observed, const std::vector<double>& expected) {
  double statistic = 0, o = 0, e = 0;
  int bins = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    o += observed[i];
    e += expected[i];
    if (e < 5) continue;
    statistic += (o - e) * (o - e) / e;
    o = e = 0;
    ++bins;
  }
  if (bins < 2) return 1;
  const double k = bins - 1, spread = 2 / (9 * k);
  return std::erfc((std::cbrt(statistic / k) - 1 + spread) / std::sqrt(2 * spread)) / 2;
}

struct Moments {
  double sum = 0, squares = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
  }
  double std_of(double n) const {
    return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)) * n / (n - 1));
  }
};

}  // namespace

SamplingCheck check_sampling(const Scatter& scatter, Vec3f view, const SamplingCheckOptions& options) {
  if (options.samples < 1000 || options.samples > 1000000000)
    throw Error(fmt::format("{} samples are out of range: use 1000 to 1e9", options.samples));
  const Polar polar(lobe_axis(scatter, view));
  const std::vector<double> edges = ring_edges(polar, lobe_width(scatter));
  const std::size_t bins = (edges.size() - 1) * sectors;
  SamplingCheck check;
  check.expected.assign(bins + 1, 0);
  check.observed.assign(bins + 1, 0);
  const Integrals total = integrate(scatter, view, polar, edges, check.expected);
  const double n = options.samples;
  for (double& e : check.expected) e *= n;
  check.expected.back() = n * std::max(0.0, 1 - total.pdf);
  check.pdf_integral = total.pdf;
  check.quadrature_albedo = {static_cast<float>(total.value[0]), static_cast<float>(total.value[1]),
                             static_cast<float>(total.value[2])};

  std::mt19937 random(options.seed);
  const auto uniform = [&random] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  Moments channel[3], largest;
  for (int i = 0; i < options.samples; ++i) {
    const Vec2f u{uniform(), uniform()};
    const ScatterSample s = sample(scatter, view, u, uniform());
    channel[0].add(s.weight.r);
    channel[1].add(s.weight.g);
    channel[2].add(s.weight.b);
    largest.add(max_channel(s.weight));
    check.largest_weight = std::max<double>(check.largest_weight, max_channel(s.weight));
    const bool taken = s.pdf > 0 && !s.is_delta();
    check.delta += (s.pdf > 0 && s.is_delta()) / n;
    check.observed[taken ? bin_of(polar, edges, s.light) : bins] += 1;
    if (!taken) continue;
    check.kept += 1 / n;
    if (i % 64 == 0)
      check.pdf_error =
          std::max(check.pdf_error, std::abs(1.0 - pdf(scatter, s.light, view) / double{s.pdf}));
  }
  const auto mean = [n](const Moments& m) { return static_cast<float>(m.sum / n); };
  const auto error = [n](const Moments& m) { return static_cast<float>(m.std_of(n) / std::sqrt(n)); };
  check.sampled_albedo = {mean(channel[0]), mean(channel[1]), mean(channel[2])};
  check.standard_error = {error(channel[0]), error(channel[1]), error(channel[2])};
  check.relative_std = largest.sum > 0 ? largest.std_of(n) / (largest.sum / n) : 0;
  check.p = chi_square_p(check.observed, check.expected);
  return check;
}

}  // namespace welkin
