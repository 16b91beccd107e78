#include <welkin/envmap/brute_force.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/envmap/patch_quadrature.h>
#include <welkin/envmap/statistics.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// 1 - cos of the angle between (theta, phi) and (theta', phi') without cancellation:
//   2 sin^2((theta - theta')/2) + 2 sin theta sin theta' sin^2((phi - phi')/2).
WELKIN_TARGET_CLONES void one_minus_cosines(double polar, double factor, const double* half_sines, double* u,
                                            int count) {
  for (int i = 0; i < count; ++i) u[i] = std::min(2.0, polar + factor * half_sines[i]);
}

WELKIN_TARGET_CLONES void add_weighted(double weight, const double* values, double* sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] += weight * values[i];
}

// Everything about one direction that the rows share.
struct LookUp {
  Vec3 direction;
  double theta = 0, phi = 0;
  std::vector<double> half_sines[3];  // sin^2((phi_i - phi)/2) at one node a texel (0) and at two (1, 2)

  LookUp(Vec3 d, int width) : direction(d) {
    const Uv uv = equirect_uv(d);
    theta = pi * uv.v;
    phi = 2 * pi * (uv.u - 0.5);
    const double offsets[3] = {0, -0.5 / std::sqrt(3.0), 0.5 / std::sqrt(3.0)};
    for (int k = 0; k < 3; ++k) {
      half_sines[k].resize(width);
      for (int x = 0; x < width; ++x) {
        const double s = std::sin(pi * (x + 0.5 + offsets[k]) / width - pi / 2 - phi / 2);
        half_sines[k][x] = s * s;
      }
    }
  }
};

// One row of a map, seen from a direction.
struct RowView {
  int width, height, row;
  double half, centre;  // half the row's height and its middle, in theta
  double half_texel;    // half the longer side of a texel
  double distance;      // from the direction to the row

  RowView(const LookUp& at, int map_width, int map_height, int map_row)
      : width(map_width),
        height(map_height),
        row(map_row),
        half(pi / (2.0 * map_height)),
        centre((2 * map_row + 1) * half) {
    half_texel = std::max(half, std::sin(centre) * pi / width);
    distance = std::max(0.0, std::abs(centre - at.theta) - half);
  }
};

struct Scratch {
  std::vector<double> u, values;
};

void add_node_row(const ZonalKernel& kernel, const LookUp& at, const RowView& row, double theta, double area,
                  int column_node, Scratch& scratch, std::vector<double>& weights) {
  const double s = std::sin(0.5 * (theta - at.theta));
  one_minus_cosines(2 * s * s, 2 * std::sin(theta) * std::sin(at.theta), at.half_sines[column_node].data(),
                    scratch.u.data(), row.width);
  evaluate(kernel, scratch.u, scratch.values);
  add_weighted(area, scratch.values.data(), weights.data(), row.width);
}

// The texels of a row that may be too near for two nodes a side get the adaptive rule.
void replace_near_texels(const ZonalKernel& kernel, const LookUp& at, const RowView& row,
                         std::vector<double>& weights) {
  const double reach = (two_node_distance + 2) * row.half_texel;
  const double flat = std::sqrt(std::max(0.0, reach * reach - row.distance * row.distance));
  const double sine =
      std::min({std::sin(at.theta), std::sin(row.centre - row.half), std::sin(row.centre + row.half)});
  const double span = std::min(pi, pi / 2 * flat / std::max(1e-9, sine));
  const int middle = static_cast<int>(std::floor((at.phi / (2 * pi) + 0.5) * row.width));
  const int columns = std::min(row.width / 2, static_cast<int>(std::ceil(span / (2 * pi) * row.width)) + 1);
  const int first = middle - columns, last = std::min(middle + columns, first + row.width - 1);
  for (int x = first; x <= last; ++x) {
    const int column = (x % row.width + row.width) % row.width;
    weights[column] =
        integrate_kernel(kernel, at.direction, equirect_patch(row.width, row.height, column, row.row));
  }
}

// The bright texels of a row that the kernel's end at 90 degrees may pass through, on either side of the axis' meridian.
// (For the others the plain rule's error, of second order in the texel and of either sign, is far below 1e-5.)
void replace_texels_at_end(const ZonalKernel& kernel, const LookUp& at, const RowView& row,
                           const float* pixels, double bright, std::vector<double>& weights) {
  // cos(phi - phi_axis) = -cot theta cot theta_axis on the horizon; clamped where the row does not reach it.
  const auto away = [&](double theta) {
    const double b = std::sin(theta) * std::sin(at.theta);
    return std::acos(std::clamp(b > 1e-12 ? -std::cos(theta) * std::cos(at.theta) / b : 2.0, -1.0, 1.0));
  };
  const double a = away(row.centre - row.half), b = away(row.centre + row.half);
  if (a == b && (a == 0 || a == pi)) return;
  const double texel = 2 * pi / row.width;
  const int first = static_cast<int>(std::floor(std::min(a, b) / texel)) - 1;
  const int last = static_cast<int>(std::ceil(std::max(a, b) / texel)) + 1;
  const int middle = static_cast<int>(std::floor((at.phi / (2 * pi) + 0.5) * row.width));
  const auto replace = [&](int x) {
    const int column = (x % row.width + row.width) % row.width;
    const float* rgb = pixels + 3 * column;
    if (std::max({rgb[0], rgb[1], rgb[2]}) > bright)
      weights[column] =
          integrate_kernel(kernel, at.direction, equirect_patch(row.width, row.height, column, row.row));
  };
  for (int offset = std::max(0, first); offset <= std::min(last, row.width / 2 + 1); ++offset) {
    replace(middle + offset);
    replace(middle - offset);
  }
}

// Weights of all texels of a row: the kernel integrated over each. Most texels are so far from the axis, or the kernel
// so wide, that one or two nodes a side do.
void row_weights(const ZonalKernel& kernel, const LookUp& at, const RowView& row, Scratch& scratch,
                 std::vector<double>& weights) {
  std::fill(weights.begin(), weights.end(), 0.0);
  const double singularity = std::hypot(row.distance, angular_width(kernel));
  if (singularity > one_node_distance * row.half_texel) {
    const double area = equirect_texel_solid_angle(row.width, row.height, row.row);
    add_node_row(kernel, at, row, row.centre, area, 0, scratch, weights);
    return;
  }
  for (double side : {-1.0, 1.0}) {
    const double theta = row.centre + side * row.half / std::sqrt(3.0);
    const double area = std::sin(theta) * row.half * pi / row.width;
    for (int column_node : {1, 2}) add_node_row(kernel, at, row, theta, area, column_node, scratch, weights);
  }
  if (singularity < two_node_distance * row.half_texel) replace_near_texels(kernel, at, row, weights);
}

void filter_one(const Image& radiance, double bright, Vec3 direction, std::span<const ZonalKernel> kernels,
                double* out) {
  const LookUp at(direction, radiance.width);
  Scratch scratch{std::vector<double>(radiance.width), std::vector<double>(radiance.width)};
  std::vector<double> weights(radiance.width);
  std::fill(out, out + 3 * kernels.size(), 0.0);
  for (int y = 0; y < radiance.height; ++y) {
    const RowView row(at, radiance.width, radiance.height, y);
    const float* pixels = radiance.at(0, y);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      row_weights(kernels[k], at, row, scratch, weights);
      if (kink_slope(kernels[k]) > steep_kink)
        replace_texels_at_end(kernels[k], at, row, pixels, bright, weights);
      double sums[3] = {};
      for (int x = 0; x < radiance.width; ++x)
        for (int c = 0; c < 3; ++c) sums[c] += weights[x] * static_cast<double>(pixels[3 * x + c]);
      for (int c = 0; c < 3; ++c) out[3 * k + c] += sums[c];
    }
  }
}

}  // namespace

std::vector<double> filter_brute_force(const Image& radiance, std::span<const Vec3> directions,
                                       std::span<const ZonalKernel> kernels) {
  assert(radiance.channels == 3);
  std::vector<double> result(directions.size() * kernels.size() * 3);
  const std::array<double, 3> mean = map_statistics(radiance).mean_radiance;
  const double bright = 4 * std::max({mean[0], mean[1], mean[2]});
  parallel_for(directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      filter_one(radiance, bright, directions[i], kernels, &result[i * kernels.size() * 3]);
  });
  return result;
}

}  // namespace welkin
