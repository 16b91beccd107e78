#include <welkin/envmap/filter_direct.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/parallel/target_clones.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// 1 - cos = |a - b|^2 / 2 for unit vectors.
WELKIN_TARGET_CLONES void one_minus_cosines(const double* x, const double* y, const double* z, Vec3 d,
                                            double* u, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = x[i] - d.x, dy = y[i] - d.y, dz = z[i] - d.z;
    u[i] = std::min(2.0, 0.5 * (dx * dx + dy * dy + dz * dz));
  }
}

double half_side(const SpherePatch& patch) {
  const double theta = 0.5 * (patch.theta0 + patch.theta1);
  return std::max(0.5 * (patch.theta1 - patch.theta0), 0.5 * (patch.phi1 - patch.phi0) * std::sin(theta));
}

// First and end of the bright texels in a row of the map.
std::pair<const BrightTexel*, const BrightTexel*> bright_of_row(const std::vector<BrightTexel>& texels,
                                                                int row) {
  const auto first = std::lower_bound(texels.begin(), texels.end(), row,
                                      [](const BrightTexel& t, int y) { return t.y < y; });
  const auto end = std::find_if(first, texels.end(), [row](const BrightTexel& t) { return t.y != row; });
  return {texels.data() + (first - texels.begin()), texels.data() + (end - texels.begin())};
}

}  // namespace

BrightSum::BrightSum(std::span<const BrightTexel> texels, const ZonalKernel& kernel)
    : texels_(texels), kernel_(kernel) {
  const double width = angular_width(kernel);
  for (const BrightTexel& texel : texels)
    if (width < one_node_distance * half_side(texel.patch)) nodes_ = 4;
  for (std::vector<double>* array : {&x_, &y_, &z_, &area_, &one_minus_cos_, &value_})
    array->resize(texels.size() * nodes_);
  for (std::size_t t = 0; t < texels.size(); ++t) {
    const SpherePatch& patch = texels[t].patch;
    const double half_theta = 0.5 * (patch.theta1 - patch.theta0), half_phi = 0.5 * (patch.phi1 - patch.phi0);
    for (int node = 0; node < nodes_; ++node) {
      const double offset = nodes_ == 1 ? 0 : 1 / std::sqrt(3.0);
      const double theta = 0.5 * (patch.theta0 + patch.theta1) + (node & 1 ? offset : -offset) * half_theta;
      const double phi = 0.5 * (patch.phi0 + patch.phi1) + (node & 2 ? offset : -offset) * half_phi;
      const std::size_t i = node * texels.size() + t;
      x_[i] = std::sin(theta) * std::cos(phi);
      y_[i] = std::cos(theta);
      z_[i] = std::sin(theta) * std::sin(phi);
      area_[i] = nodes_ == 1 ? texels[t].solid_angle : std::sin(theta) * half_theta * half_phi;
    }
    const double half = half_side(patch), need = (nodes_ == 1 ? one_node_distance : two_node_distance) * half;
    const double reach = width < need ? need + 1.5 * half : 0;
    reach_squared_.push_back(reach * reach);
    end_reach_.push_back(kink_slope(kernel) > steep_kink ? 2.2 * half : 0);
  }
}

void BrightSum::add(Vec3 direction, double scale, double* rgb) {
  one_minus_cosines(x_.data(), y_.data(), z_.data(), direction, one_minus_cos_.data(), x_.size());
  evaluate(kernel_, one_minus_cos_, value_);
  for (std::size_t t = 0; t < texels_.size(); ++t) {
    double integral = 0;
    if (2 * one_minus_cos_[t] < reach_squared_[t] || std::abs(1 - one_minus_cos_[t]) < end_reach_[t]) {
      integral = integrate_kernel(kernel_, direction, texels_[t].patch);
    } else {
      for (std::size_t i = t; i < value_.size(); i += texels_.size()) integral += area_[i] * value_[i];
    }
    for (int c = 0; c < 3; ++c) rgb[c] += scale * integral * texels_[t].radiance[c];
  }
}

void add_core(const BrightSplit& split, const ZonalKernel& kernel, double near_angle, Vec3 direction,
              double scale, double* rgb) {
  const Image& map = *split.map;
  const Uv uv = equirect_uv(direction);
  const double theta = pi * uv.v;
  const int first_row = std::max(0, static_cast<int>(std::floor((theta - near_angle) / pi * map.height)));
  const int last_row =
      std::min(map.height - 1, static_cast<int>(std::floor((theta + near_angle) / pi * map.height)));
  for (int row = first_row; row <= last_row; ++row) {
    const double sine = std::min(std::sin(pi * row / map.height), std::sin(pi * (row + 1) / map.height));
    // Chord in azimuth >= 2 sqrt(sine sin theta) sin(dphi/2) must not exceed that of near_angle.
    const double ratio =
        std::sin(std::min(0.5 * near_angle, pi / 2)) / std::max(1e-12, std::sqrt(sine * std::sin(theta)));
    const double dphi = ratio >= 1 ? pi : 2 * std::asin(ratio);
    const int middle = static_cast<int>(uv.u * map.width);
    const int columns = std::min(map.width / 2, static_cast<int>(std::ceil(dphi / (2 * pi) * map.width)) + 1);
    const int first = middle - columns, last = std::min(middle + columns, first + map.width - 1);
    const auto [bright, bright_end] = bright_of_row(split.texels, row);
    for (int x = first; x <= last; ++x) {
      const int column = (x % map.width + map.width) % map.width;
      const double weight =
          scale *
          integrate_kernel(kernel, direction, equirect_patch(map.width, map.height, column, row), near_angle);
      const float* value = map.at(column, row);
      for (const BrightTexel* t = bright; t != bright_end; ++t)
        if (t->x == column) value = t->rest.data();
      for (int c = 0; c < 3; ++c) rgb[c] += weight * static_cast<double>(value[c]);
    }
  }
}

}  // namespace welkin
