#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/envmap/sky/rgb.h>
#include <welkin/image/image.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// How finely average_over_texels looks into a texel.
struct TexelAverageOptions {
  /// Nodes across the whole height at least, and twice as many around, so that small maps average as well as large
  /// ones, whatever their proportion; at most 64 down a texel.
  int nodes_per_height = 1024;
  int nodes_per_texel = 1;  // at least, along each axis
};

/// Fills `image` with the mean of a function of direction over each texel's solid angle: Gauss-Legendre in
/// y = cos(zenith angle) and in azimuth; rows that straddle the horizon are done in two halves. The function comes in
/// two steps: row_function(y) returns a callable that takes the unit direction at that height and returns Rgb.
template <class RowFunction>
void average_over_texels(Image& image, const TexelAverageOptions& options, RowFunction&& row_function) {
  constexpr double pi = std::numbers::pi;
  const int wanted = (options.nodes_per_height + image.height - 1) / image.height;
  const QuadratureRule rule = gauss_legendre(std::clamp(wanted, options.nodes_per_texel, 64));
  const int heights = static_cast<int>(rule.nodes.size());
  // A turn is twice as long as the height: a column of a narrow map needs many more nodes across than down.
  const int wanted_across = (2 * options.nodes_per_height + image.width - 1) / image.width;
  const QuadratureRule across_rule = gauss_legendre(std::max(wanted_across, options.nodes_per_texel));
  const int nodes = static_cast<int>(across_rule.nodes.size());
  std::vector<Vec3> azimuths(static_cast<std::size_t>(image.width) * nodes);
  for (int x = 0; x < image.width; ++x)
    for (int i = 0; i < nodes; ++i) {
      const double phi = 2 * pi * ((x + (1 + across_rule.nodes[i]) / 2) / image.width - 0.5);
      azimuths[static_cast<std::size_t>(x) * nodes + i] = {std::cos(phi), 0, std::sin(phi)};
    }
  const auto add_band = [&](double low, double high, double share, std::vector<Rgb>& row) {
    for (int k = 0; k < heights; ++k) {
      const double y = low + (high - low) * (1 + rule.nodes[k]) / 2;
      const double across = std::sqrt(std::max(0.0, (1 - y) * (1 + y)));
      auto at = row_function(y);
      for (int x = 0; x < image.width; ++x)
        for (int i = 0; i < nodes; ++i) {
          const Vec3 azimuth = azimuths[static_cast<std::size_t>(x) * nodes + i];
          const double weight = share * rule.weights[k] * across_rule.weights[i] / 4;
          row[x] = row[x] + weight * at(Vec3{across * azimuth.x, y, across * azimuth.z});
        }
    }
  };
  parallel_for(image.height, 4, [&](std::size_t begin, std::size_t end) {
    std::vector<Rgb> row(image.width);
    for (std::size_t j = begin; j < end; ++j) {
      std::fill(row.begin(), row.end(), Rgb{});
      const double high = std::cos(pi * static_cast<double>(j) / image.height);
      const double low = std::cos(pi * static_cast<double>(j + 1) / image.height);
      if (2 * j < static_cast<std::size_t>(image.height) &&
          2 * (j + 1) > static_cast<std::size_t>(image.height)) {
        add_band(0, high, high / (high - low), row);
        add_band(low, 0, -low / (high - low), row);
      } else {
        add_band(low, high, 1, row);
      }
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, static_cast<int>(j))[c] = static_cast<float>(row[x][c]);
    }
  });
}

}  // namespace welkin
