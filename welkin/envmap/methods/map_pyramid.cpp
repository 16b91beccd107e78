#include <welkin/envmap/methods/map_pyramid.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

int nodes_along(int texels, int level) { return ((texels - 1) >> level) + 1; }

}  // namespace

MapPyramid::MapPyramid(const Image& equirect) : map_(equirect) {
  levels_.emplace_back();
  lay_out(0);
  while (columns(top()) > 1 || rows(top()) > 1) {
    Image next = halved(levels_.size() == 1 ? map_ : levels_.back().means, top());
    levels_.emplace_back();
    levels_.back().means = std::move(next);
    lay_out(top());
  }
}

SpherePatch MapPyramid::patch(int level, int x, int y) const {
  const double row = pi / map_.height, column = 2 * pi / map_.width;
  return {row * (y << level), row * std::min(map_.height, (y + 1) << level), column * (x << level) - pi,
          column * std::min(map_.width, (x + 1) << level) - pi};
}

// cos theta0 - cos theta1 as a product, which keeps its digits at the poles.
void MapPyramid::lay_out(int level) {
  Level& at = levels_[level];
  double widest = 0;
  for (int x = 0; x < nodes_along(map_.width, level); ++x) {
    const SpherePatch p = patch(level, x, 0);
    at.cos_phi.push_back(std::cos((p.phi0 + p.phi1) / 2));
    at.sin_phi.push_back(std::sin((p.phi0 + p.phi1) / 2));
    at.width.push_back(p.phi1 - p.phi0);
    widest = std::max(widest, p.phi1 - p.phi0);
  }
  for (int y = 0; y < nodes_along(map_.height, level); ++y) {
    const SpherePatch p = patch(level, 0, y);
    const double middle = (p.theta0 + p.theta1) / 2, half = (p.theta1 - p.theta0) / 2;
    const double longest = std::sin(std::clamp(pi / 2, p.theta0, p.theta1));  // of its parallels
    at.rows.push_back({std::sin(middle), std::cos(middle), 2 * std::sin(middle) * std::sin(half),
                       std::max(half, longest * widest / 2)});
  }
}

Image MapPyramid::halved(const Image& finer, int level) const {
  Image coarser(nodes_along(finer.width, 1), nodes_along(finer.height, 1));
  for (int y = 0; y < coarser.height; ++y)
    for (int x = 0; x < coarser.width; ++x) {
      double sum[3] = {}, weight = 0;
      for (int fy = 2 * y; fy < std::min(2 * y + 2, finer.height); ++fy)
        for (int fx = 2 * x; fx < std::min(2 * x + 2, finer.width); ++fx) {
          const double area = solid_angle(level, fx, fy);
          for (int c = 0; c < 3; ++c) sum[c] += area * static_cast<double>(finer.at(fx, fy)[c]);
          weight += area;
        }
      for (int c = 0; c < 3; ++c) coarser.at(x, y)[c] = static_cast<float>(sum[c] / weight);
    }
  return coarser;
}

}  // namespace welkin
