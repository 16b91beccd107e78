#include <welkin/envmap/methods/spline_mips.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {

SplineMips::Level SplineMips::empty_level(int size) {
  Level level;
  level.size = size;
  level.texels.resize(std::size_t{24} * (size + 2) * (size + 2));
  return level;
}

// The border continues the face's plane by half a texel; in a corner stands the mean of the three texels that meet.
void SplineMips::Level::fill_borders() {
  const int n = size;
  const auto outside = [&](int face, int x, int y) {
    const CubePoint p = cube_point(cube_ray({face, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1}));
    const auto texel = [n](double s) { return std::clamp(static_cast<int>((s + 1) * 0.5 * n), 0, n - 1); };
    std::copy_n(at(p.face, texel(p.s), texel(p.t)), 4, at(face, x, y));
  };
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < n; ++i)
      for (int end : {-1, n}) {
        outside(face, i, end);
        outside(face, end, i);
      }
    for (int y : {-1, n})
      for (int x : {-1, n}) {
        const int inner_x = std::clamp(x, 0, n - 1), inner_y = std::clamp(y, 0, n - 1);
        for (int c = 0; c < 4; ++c)
          at(face, x, y)[c] =
              (at(face, inner_x, inner_y)[c] + at(face, x, inner_y)[c] + at(face, inner_x, y)[c]) / 3;
      }
  }
}

SplineMips::Level SplineMips::halved(const Level& fine) {
  Level coarse = empty_level(fine.size / 2);
  const int n = fine.size;
  static constexpr double spline[4] = {1, 3, 3, 1};
  // Solid angle of a fine texel up to a factor; the border mirrors the row beside it.
  const auto density = [n](int i, int j) {
    const auto centre = [n](int k) { return (2 * std::clamp(k, 0, n - 1) + 1.0) / n - 1; };
    const double s = centre(i), t = centre(j), r2 = 1 + s * s + t * t;
    return 1 / (r2 * std::sqrt(r2));
  };
  parallel_for(static_cast<std::size_t>(coarse.size), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < coarse.size; ++x) {
        double sums[6][3] = {}, total = 0;
        for (int j = 0; j < 4; ++j)
          for (int i = 0; i < 4; ++i) {
            const int fx = 2 * x - 1 + i, fy = 2 * y - 1 + j;
            if ((fx < 0 || fx >= n) && (fy < 0 || fy >= n)) continue;
            const double weight = spline[i] * spline[j] * density(fx, fy);
            total += weight;
            for (int face = 0; face < 6; ++face)
              for (int c = 0; c < 3; ++c)
                sums[face][c] += weight * static_cast<double>(fine.at(face, fx, fy)[c]);
          }
        for (int face = 0; face < 6; ++face)
          for (int c = 0; c < 3; ++c) coarse.at(face, x, y)[c] = static_cast<float>(sums[face][c] / total);
      }
  });
  coarse.fill_borders();
  return coarse;
}

SplineMips::SplineMips(const Cube& cube) {
  levels_.push_back(empty_level(cube.size));
  Level& first = levels_.front();
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) std::copy_n(cube.at(face, x, y), 3, first.at(face, x, y));
  first.fill_borders();
  while (levels_.back().size > 1) levels_.push_back(halved(levels_.back()));
}

// A texel's footprint is a box of variance 1/12, bilinear interpolation adds 1/6 of its level's texels, and each step
// of 1 3 3 1 adds 3/4 of the finer level's: in texels of level 0, level k has 5/12 4^k - 1/6.
double SplineMips::least_deviation() const {
  const double texel = std::sqrt(4 * std::numbers::pi / 6) / levels_.front().size;
  return 0.5 * texel;
}

void SplineMips::Level::add_bilinear(int face, double s, double t, double weight, double* rgb) const {
  const double x = (s + 1) * 0.5 * size + 0.5, y = (t + 1) * 0.5 * size + 0.5;  // in the bordered face
  const int x0 = std::min(static_cast<int>(x), size), y0 = std::min(static_cast<int>(y), size);
  const double fx = x - x0, fy = y - y0;
  const float* above = at(face, x0 - 1, y0 - 1);
  const float* below = at(face, x0 - 1, y0);
  const float w[4] = {static_cast<float>(weight * (1 - fx) * (1 - fy)),
                      static_cast<float>(weight * fx * (1 - fy)), static_cast<float>(weight * (1 - fx) * fy),
                      static_cast<float>(weight * fx * fy)};
  for (int c = 0; c < 3; ++c)
    rgb[c] += static_cast<double>(w[0]) * static_cast<double>(above[c]) +
              static_cast<double>(w[1]) * static_cast<double>(above[c + 4]) +
              static_cast<double>(w[2]) * static_cast<double>(below[c]) +
              static_cast<double>(w[3]) * static_cast<double>(below[c + 4]);
}

// At (s, t) of a face a texel is 2/size (1 + s^2 + t^2)^(-3/4) wide (root of its solid angle). Between levels k and k
// + 1 the variance is linear in the share of the upper: 5/12 4^k (1 + 3 share) - 1/6.
void SplineMips::add_look_up(Vec3 direction, double deviation, double weight, double* rgb) const {
  const CubePoint p = cube_point(direction);
  const double n = levels_.front().size, r2 = 1 + p.s * p.s + p.t * p.t;
  const double variance = 0.25 * deviation * deviation * n * n * r2 * std::sqrt(r2);  // in texels
  const double wanted = (variance + 1.0 / 6) * 12 / 5;
  const int last = static_cast<int>(levels_.size()) - 1;
  const int level = wanted < 1 ? 0 : std::min(std::ilogb(wanted) / 2, last);
  const double share = level < last ? std::clamp((std::ldexp(wanted, -2 * level) - 1) / 3, 0.0, 1.0) : 0.0;
  if (share < 1) levels_[level].add_bilinear(p.face, p.s, p.t, weight * (1 - share), rgb);
  if (share > 0) levels_[level + 1].add_bilinear(p.face, p.s, p.t, weight * share, rgb);
}

}  // namespace welkin
