#include <welkin/envmap/reflection/tap_fit.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/brdf/ggx.h>
#include <welkin/envmap/level_law.h>
#include <welkin/envmap/zonal_kernel.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_degree = 500;
constexpr double bin_scale = 1e-5;  // in 1 - cos: bins are equally wide up to there, then in proportion
constexpr int bin_total = 256;      // in angle, crowded towards 0
constexpr int angle_total = 48;     // of a tap, over the lobe's neighbourhood
constexpr int lobe_points = 256;    // that stand for the lobe
constexpr double ridge = 1e-6;      // of the largest product: taps that coincide share their weight
constexpr double aversion = 10;     // to negative weights, which turn into dark halos of lamps
constexpr int max_taps = 6;

// The lobe f cos as points by visible normals (Heitz 2018): a point has the weight G2 / G1, times the Fresnel factor
// 1 - c or c, c = (1 - v.h)^5. u2 runs in steps of the golden ratio. Both sums are set to the exact DFG.
struct LobePoint {
  double x, z, scale, bias;  // x along the mirror's direction; the y's average out, see TapLobe
  double y;
};

std::vector<LobePoint> make_lobe_points(double cos_view, double alpha, DfgValue dfg) {
  const LocalVec view{-std::sqrt((1 - cos_view) * (1 + cos_view)), 0, cos_view};
  std::vector<LobePoint> points;
  double scale = 0, bias = 0;
  for (int i = 0; i < lobe_points; ++i) {
    const double u2 = std::fmod(0.5 + i * (std::numbers::phi - 1), 1.0);
    const LocalVec half = sample_ggx_visible_normal(view, alpha, (i + 0.5) / lobe_points, u2);
    const LocalVec light = reflected(view, half);
    if (light.z <= 0) continue;
    const double weight = ggx_masking_shadowing(cos_view, light.z, alpha) / ggx_masking(cos_view, alpha);
    const double c = fresnel_schlick(dot(view, half), 0);
    points.push_back({light.x, light.z, weight * (1 - c), weight * c, light.y});
    scale += weight * (1 - c);
    bias += weight * c;
  }
  for (LobePoint& p : points) {
    p.scale *= dfg.scale / scale;
    p.bias *= bias > 0 ? dfg.bias / bias : 0;
  }
  return points;
}

// P_0 .. P_degree at one cosine.
void fill_legendre(double x, std::span<double> out) {
  out[0] = 1;
  out[1] = x;
  for (std::size_t l = 1; l + 1 < out.size(); ++l) {
    const double n = static_cast<double>(l);
    out[l + 1] = ((2 * n + 1) * x * out[l] - n * out[l - 1]) / (n + 1);
  }
}

double dot_product(std::span<const double> a, const double* b) {
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

double one_minus_cos(double angle) {
  const double s = std::sin(0.5 * angle);
  return 2 * s * s;
}

struct Between {
  int first;
  double share;  // of first + 1
};

Between between(double where, int count) {
  const double x = std::clamp(where, 0.0, static_cast<double>(count - 1));
  const int first = std::min(static_cast<int>(x), count - 2);
  return {first, x - first};
}

// A level's kernel as a sampler sees it: bilinear interpolation between texels of angle h is a tent, of variance h^2 / 6
// along each axis, and a texel of level 0 is a mean over its box (h^2 / 12 more); both as a Gaussian.
std::vector<double> sampled_kernel(const ChainShape& chain, int level) {
  const double texel = std::sqrt(4 * pi / 6) / (chain.size >> level);
  const double variance = texel * texel * (level == 0 ? 0.25 : 1.0 / 6);
  std::vector<double> k(max_degree + 1, 1.0);
  if (level > 0) {
    const double r = level_to_perceptual_roughness(chain.law, level, chain.levels, chain.size);
    k = legendre_coefficients(kernel_for_alpha(KernelKind::ggx, r * r), max_degree);
  }
  for (int l = 0; l <= max_degree; ++l) k[l] *= std::exp(-0.5 * l * (l + 1.0) * variance);
  return k;
}

double bin_of(double u) {
  return std::log(1 + u / bin_scale) * ((bin_total - 1) / std::log1p(2 / bin_scale));
}

}  // namespace

TapSpace::TapSpace(const ChainShape& chain, double light_power) : chain_(chain) {
  const int levels = chain.levels;
  std::vector<std::vector<double>> kernels;
  for (int k = 0; k < levels; ++k) kernels.push_back(sampled_kernel(chain, k));
  std::vector<double> light(max_degree + 1), weights(max_degree + 1);
  for (int l = 1; l <= max_degree; ++l) light[l] = (2 * l + 1) * std::pow(l + 0.5, -light_power);
  std::vector<double> legendre(static_cast<std::size_t>(bin_total) * (max_degree + 1));
  for (int b = 0; b < bin_total; ++b) {
    const double u = bin_scale * std::expm1(b * std::log1p(2 / bin_scale) / (bin_total - 1));
    fill_legendre(
        1 - u, std::span(legendre).subspan(static_cast<std::size_t>(b) * (max_degree + 1), max_degree + 1));
  }
  point_product_.resize(static_cast<std::size_t>(bin_total) * levels);
  product_.resize(point_product_.size() * levels);
  const auto fill = [&](double* out, int stride) {
    for (int b = 0; b < bin_total; ++b)
      out[b * stride] = dot_product(weights, &legendre[static_cast<std::size_t>(b) * (max_degree + 1)]);
  };
  for (int i = 0; i < levels; ++i) {
    for (int l = 0; l <= max_degree; ++l) weights[l] = light[l] * kernels[i][l];
    fill(&point_product_[i], levels);
    for (int j = 0; j <= i; ++j) {
      for (int l = 0; l <= max_degree; ++l) weights[l] = light[l] * kernels[i][l] * kernels[j][l];
      double* row = &product_[static_cast<std::size_t>(i * levels + j) * bin_total];
      fill(row, 1);
      std::copy(row, row + bin_total, &product_[static_cast<std::size_t>(j * levels + i) * bin_total]);
    }
  }
}

double TapSpace::level_of(double perceptual_roughness) const {
  return perceptual_roughness_to_level(chain_.law, perceptual_roughness, chain_.levels, chain_.size);
}

double TapSpace::first_roughness() const {
  return level_to_perceptual_roughness(chain_.law, 1, chain_.levels, chain_.size);
}

double TapSpace::product(double level_a, double level_b, double u) const {
  const int levels = chain_.levels;
  const Between bin = between(bin_of(u), bin_total);
  const Between a = between(level_a, levels), b = between(level_b, levels);
  const auto at = [&](int i, int j) {
    const double* row = &product_[static_cast<std::size_t>(i * levels + j) * bin_total + bin.first];
    return row[0] + bin.share * (row[1] - row[0]);
  };
  const double lower = at(a.first, b.first) + b.share * (at(a.first, b.first + 1) - at(a.first, b.first));
  const double upper =
      at(a.first + 1, b.first) + b.share * (at(a.first + 1, b.first + 1) - at(a.first + 1, b.first));
  return lower + a.share * (upper - lower);
}

void TapSpace::add_point_products(double u, double weight, std::span<double> out) const {
  const int levels = chain_.levels;
  const Between bin = between(bin_of(u), bin_total);
  const double* row = &point_product_[static_cast<std::size_t>(bin.first) * levels];
  for (int i = 0; i < levels; ++i) out[i] += weight * (row[i] + bin.share * (row[i + levels] - row[i]));
}

// Only taps in the plane of incidence are asked for, so a point's mirror image beyond that plane has the same angle
// to them, and points need not be symmetric.
TapLobe::TapLobe(const TapSpace& space, double cos_view, double perceptual_roughness)
    : space_(space),
      cos_view_(cos_view),
      sin_view_(std::sqrt((1 - cos_view) * (1 + cos_view))),
      roughness_(perceptual_roughness) {
  assert(cos_view > 0 && cos_view <= 1 && roughness_ > 0 && roughness_ <= 1);
  const double alpha = roughness_ * roughness_;
  dfg_ = integrate_dfg(cos_view, alpha);
  const std::vector<LobePoint> points = make_lobe_points(cos_view, alpha, dfg_);
  const double mirror = std::acos(cos_view);
  first_angle_ = std::max(-0.7, mirror - 6 * alpha - 0.02);
  last_angle_ = std::min(pi / 2, mirror + 4 * alpha + 0.02);
  const std::size_t levels = space.level_count();
  scale_.resize(angle_total * levels);
  bias_.resize(scale_.size());
  for (int i = 0; i < angle_total; ++i) {
    const double angle = first_angle_ + (last_angle_ - first_angle_) * i / (angle_total - 1);
    const double x = std::sin(angle), z = std::cos(angle);
    const auto row = [&](std::vector<double>& table) { return std::span(table).subspan(i * levels, levels); };
    for (const LobePoint& p : points) {
      const double dx = p.x - x, dz = p.z - z, u = 0.5 * (dx * dx + p.y * p.y + dz * dz);
      space.add_point_products(u, p.scale, row(scale_));
      space.add_point_products(u, p.bias, row(bias_));
    }
  }
}

double TapLobe::angle_of(const StretchedTap& tap) const {
  return std::acos(cos_view_) + std::atan(tap.offset * sin_view_);
}

void TapLobe::limit(StretchedTap& tap) const {
  const double first = space_.first_roughness();
  const double sharpest = std::max(0.4 * roughness_, std::min(first, roughness_));
  tap.perceptual_roughness = std::clamp(tap.perceptual_roughness, sharpest, 1.0);
  const double mirror = std::acos(cos_view_), sine = std::max(sin_view_, 1e-3);
  tap.offset = std::clamp(tap.offset, std::tan(std::max(first_angle_ - mirror, -1.5)) / sine,
                          std::tan(std::min(last_angle_ - mirror, 1.5)) / sine);
}

TapLobe::Product TapLobe::lobe_product(double angle, double level) const {
  const int levels = space_.level_count();
  const Between a =
      between((angle - first_angle_) / (last_angle_ - first_angle_) * (angle_total - 1), angle_total);
  const Between b = between(level, levels);
  const auto at = [&](const std::vector<double>& table) {
    const double* row = &table[static_cast<std::size_t>(a.first) * levels + b.first];
    const double lower = row[0] + b.share * (row[1] - row[0]);
    const double upper = row[levels] + b.share * (row[levels + 1] - row[levels]);
    return lower + a.share * (upper - lower);
  };
  return {at(scale_), at(bias_)};
}

double TapLobe::error(std::span<const StretchedTap> taps, const std::vector<double>& gram,
                      std::span<const Product> lobe, double unit) const {
  const std::size_t count = taps.size();
  double total = 0;
  for (double f0 : {0.04, 1.0}) {
    const auto weight = [&](std::size_t i) { return f0 * taps[i].scale + taps[i].bias; };
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      sum -= 2 * weight(i) * (f0 * lobe[i].scale + lobe[i].bias);
      for (std::size_t j = 0; j < count; ++j) sum += weight(i) * weight(j) * gram[i * count + j];
      const double below = std::min(0.0, weight(i));
      sum += aversion * unit * below * below;
    }
    const double reflectance = f0 * dfg_.scale + dfg_.bias;
    total += sum / (reflectance * reflectance);
  }
  return total;
}

// Lagrange: [G 1; 1 0] (w, m) = (<lobe, K>, integral), G with a small ridge; once for scale, once for bias, by
// elimination with pivots.
double TapLobe::solve(std::span<StretchedTap> taps) const {
  const int count = static_cast<int>(taps.size());
  assert(count >= 1 && count <= max_taps);
  std::vector<double> gram(static_cast<std::size_t>(count) * count);
  std::array<Product, max_taps> lobe;
  std::array<double, max_taps> angles{}, levels{};
  double unit = 0;
  for (int i = 0; i < count; ++i) {
    limit(taps[i]);
    angles[i] = angle_of(taps[i]);
    levels[i] = space_.level_of(taps[i].perceptual_roughness);
    lobe[i] = lobe_product(angles[i], levels[i]);
    for (int j = 0; j <= i; ++j)
      gram[i * count + j] = gram[j * count + i] =
          space_.product(levels[i], levels[j], one_minus_cos(angles[i] - angles[j]));
    unit = std::max(unit, gram[i * count + i]);
  }
  std::array<std::array<double, max_taps + 3>, max_taps + 1> a{};
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) a[i][j] = gram[i * count + j] + (i == j ? ridge * unit : 0);
    a[i][count] = a[count][i] = unit;
    a[i][count + 1] = lobe[i].scale;
    a[i][count + 2] = lobe[i].bias;
  }
  a[count][count + 1] = unit * dfg_.scale;
  a[count][count + 2] = unit * dfg_.bias;
  for (int c = 0; c <= count; ++c) {
    int pivot = c;
    for (int i = c + 1; i <= count; ++i)
      if (std::abs(a[i][c]) > std::abs(a[pivot][c])) pivot = i;
    std::swap(a[c], a[pivot]);
    for (int i = 0; i <= count; ++i) {
      if (i == c) continue;
      const double factor = a[i][c] / a[c][c];
      for (int j = c; j < count + 3; ++j) a[i][j] -= factor * a[c][j];
    }
  }
  for (int i = 0; i < count; ++i) {
    taps[i].scale = a[i][count + 1] / a[i][i];
    taps[i].bias = a[i][count + 2] / a[i][i];
  }
  return error(taps, gram, std::span(lobe).first(count), unit);
}

}  // namespace welkin
