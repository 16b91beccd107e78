#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cell_coverage.h>
#include <welkin/sphere/mapping.h>
#include <welkin/sphere/mat3.h>

// Inside of resample.cpp: the mean of a map, as patches of constant radiance, over the patch of another map's texel, as
// the weights of the source's texels: they depend on the shapes alone, not on what the map shows.

namespace welkin {

using ChannelSum = std::array<double, 4>;

// How much of texel (x, y) of the source a target texel gets. A list of them may name a texel more than once.
struct TexelWeight {
  int x = 0, y = 0;
  double weight = 0;
};

// Texels of someone else's image or cube.
struct MapSource {
  MapShape shape;
  int channels = 3;
  const float* pixels = nullptr;
  Mat3 from_target;  // turns a direction of the target into the source's frame

  std::vector<double> row_skew;  // of an equirectangular map, see point(); else empty

  // Where a direction of the target falls. Inside an equirectangular row the solid angle per height varies like
  // sin theta, near the poles by all of itself: there y is bent within its row so that covered area is in proportion
  // to solid angle. With sin theta linear in the row's fraction f, its integral is f + skew (f^2 - f), with
  // skew = (pi / H) cot(theta of the row's middle) / 2; at the poles f^2 and 2f - f^2.
  MapPoint point(Vec3 target_direction) const {
    MapPoint p = map_point(shape, from_target * target_direction);
    if (row_skew.empty()) return p;
    const int row = std::clamp(static_cast<int>(p.y), 0, shape.height - 1);
    const double f = p.y - row;
    p.y += row_skew[static_cast<std::size_t>(row)] * (f * f - f);
    return p;
  }

  const float* at(int x, int y) const {
    return pixels + (static_cast<std::size_t>(y) * shape.width + x) * channels;
  }
};

inline std::vector<double> row_skews(MapShape shape) {
  if (shape.mapping != Mapping::equirectangular) return {};
  std::vector<double> skews(static_cast<std::size_t>(shape.height));
  const double step = std::numbers::pi / shape.height;
  for (std::size_t row = 0; row < skews.size(); ++row) {
    skews[row] = std::clamp(step / std::tan((static_cast<double>(row) + 0.5) * step) / 2, -1.0, 1.0);
  }
  return skews;
}

// Solid angle per texel area over a source texel: sums of coverage are weighted with it. One number per row of an
// equirectangular map, one per texel of a face of a cube, one per texel otherwise; 0 outside discs.
class DensityTable {
 public:
  explicit DensityTable(MapShape shape) : shape_(shape) {
    const bool rows_only = shape.mapping == Mapping::equirectangular;
    columns_ = rows_only ? 1 : shape.width;
    rows_ = shape.mapping == Mapping::cube ? shape.width : shape.height;
    density_.resize(static_cast<std::size_t>(columns_) * rows_);
    parallel_for(static_cast<std::size_t>(rows_), 16, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        for (int x = 0; x < columns_; ++x)
          density_[static_cast<std::size_t>(y) * columns_ + x] = density(x, y);
      }
    });
  }

  double at(int x, int y) const {
    if (columns_ == 1 && shape_.mapping == Mapping::equirectangular)
      return density_[static_cast<std::size_t>(y)];
    return density_[static_cast<std::size_t>(y % rows_) * columns_ + x];
  }

 private:
  float density(int x, int y) const {
    if (shape_.mapping == Mapping::equirectangular)
      return static_cast<float>(map_texel_solid_angle(shape_, x, y));
    const bool covered = map_covers(shape_, x, y) || map_texel_solid_angle(shape_, x, y) > 0;
    return covered ? static_cast<float>(map_density(shape_, map_texel_direction(shape_, x, y))) : 0.0f;
  }

  MapShape shape_;
  int columns_ = 1, rows_ = 1;
  std::vector<float> density_;
};

// The mean of the source over the patch of a target texel, as weights that add up to 1. The patch is a quadrilateral between its corners' images
// on the source's grid; where that is a bad picture of it (it crosses a cut, or its edges are curved by more than
// flat_enough texels) it is quartered, and at the last depth represented by its middle.
class PatchMean {
 public:
  // Only texels of the first `columns` columns will be asked for.
  PatchMean(const MapSource& source, const DensityTable& density, MapShape target, int columns)
      : source_(source), density_(density), target_(target), columns_(columns) {
    const double source_texels = static_cast<double>(source.shape.width) * source.shape.height;
    const double ratio = std::sqrt(source_texels / target.width / target.height);
    middle_ = target.mapping == Mapping::dual_paraboloid ? target.height : target.width;
    // Inside a quadrilateral the target's density counts as constant: at most 0.15 rad of it.
    const double texel = std::sqrt(4 * std::numbers::pi / target.width / target.height);
    min_depth_ = std::max(0, static_cast<int>(std::ceil(std::log2(texel / 0.15))));
    max_depth_ = 5 + min_depth_ + std::max(0, static_cast<int>(std::ceil(std::log2(ratio))));
  }

  // The weights of target texel (x, y), valid until the next call.
  std::span<TexelWeight> operator()(int x, int y) {
    weights_.clear();
    total_ = 0;
    if (min_depth_ > 0 || !add_whole(x, y)) gather(x, y, {0, 0}, 1, 0);
    if (total_ <= 0) add_point(source_.point(map_texel_direction(target_, x, y)), 1);
    for (TexelWeight& w : weights_) w.weight /= total_;
    return weights_;
  }

 private:
  static constexpr double flat_enough = 0.01;

  // The whole texel at once, with the corners that it shares with its neighbours looked up.
  bool add_whole(int x, int y) {
    if (y != row_) prepare_row(y);
    for (int k = 0; k < 4; ++k) {
      if (!map_covers(target_, x, y, k % 2, k / 2)) return false;
    }
    const auto left = static_cast<std::size_t>(x + (x >= middle_ ? 1 : 0));
    const MapPoint centre = source_.point(map_texel_direction(target_, x, y));
    return add_quad({above_[left], above_[left + 1], below_[left + 1], below_[left]}, centre, 1);
  }

  // Corners along the upper and lower sides of a row of target texels. The two squares of a dual paraboloid do not
  // share theirs: corner `middle_` is there twice.
  void prepare_row(int y) {
    const int face_height = target_.mapping == Mapping::cube ? target_.width : target_.height;
    if (y == row_ + 1 && y % face_height != 0) {
      above_.swap(below_);
    } else {
      corner_row(y, 0, above_);
    }
    corner_row(y, 1, below_);
    row_ = y;
  }

  void corner_row(int y, double fy, std::vector<MapPoint>& corners) const {
    corners.clear();
    for (int x = 0; x < columns_; ++x) {
      corners.push_back(source_.point(map_texel_direction(target_, x, y, 0, fy)));
      if (x + 1 == middle_ || x + 1 == columns_) {
        corners.push_back(source_.point(map_texel_direction(target_, x, y, 1, fy)));
      }
    }
  }

  void gather(int x, int y, GridPoint corner, double step, int depth) {
    const double fx[] = {corner.x, corner.x + step, corner.x + step, corner.x};
    const double fy[] = {corner.y, corner.y, corner.y + step, corner.y + step};
    const GridPoint middle{corner.x + step / 2, corner.y + step / 2};
    int covered = 0;
    for (int k = 0; k < 4; ++k) covered += map_covers(target_, x, y, fx[k], fy[k]) ? 1 : 0;
    if (covered == 0 && depth >= 2) return;
    const Vec3 direction = map_texel_direction(target_, x, y, middle.x, middle.y);
    const MapPoint centre = source_.point(direction);
    const double solid_angle = map_density(target_, direction) * step * step;
    if (covered == 4 && depth >= min_depth_) {
      std::array<MapPoint, 4> points;
      for (std::size_t k = 0; k < 4; ++k) {
        points[k] = source_.point(map_texel_direction(target_, x, y, fx[k], fy[k]));
      }
      if (add_quad(points, centre, solid_angle)) return;
    }
    if (depth >= max_depth_) {
      if (map_covers(target_, x, y, middle.x, middle.y)) add_point(centre, solid_angle);
      return;
    }
    for (GridPoint quarter : {corner, GridPoint{middle.x, corner.y}, GridPoint{corner.x, middle.y}, middle}) {
      gather(x, y, quarter, step / 2, depth + 1);
    }
  }

  bool add_quad(const std::array<MapPoint, 4>& points, MapPoint centre, double solid_angle) {
    std::array<GridPoint, 4> quad;
    GridPoint mean;
    int chart = centre.chart;
    for (std::size_t k = 0; k < 4; ++k) {
      if (points[k].chart != 0 && chart != 0 && points[k].chart != chart) return false;
      chart = std::max(chart, points[k].chart);
      quad[k] = {near_in_x(points[k].x, centre.x), points[k].y};
      mean = {mean.x + quad[k].x / 4, mean.y + quad[k].y / 4};
    }
    if (std::abs(mean.x - centre.x) > flat_enough || std::abs(mean.y - centre.y) > flat_enough) return false;
    if (!coverage_.measure(quad)) return false;
    return add_covered_cells(solid_angle);
  }

  // Longitude goes round: the image of x that is nearest to `reference`.
  double near_in_x(double x, double reference) const {
    if (source_.shape.mapping != Mapping::equirectangular) return x;
    return x + source_.shape.width * std::round((reference - x) / source_.shape.width);
  }

  bool add_covered_cells(double solid_angle) {
    const std::size_t first = weights_.size();
    double covered = 0;
    for (int row = 0; row < coverage_.height(); ++row) {
      const int y = std::min(coverage_.y0() + row, source_.shape.height - 1);
      const auto cells = coverage_.row(row);
      for (int i = 0; i < coverage_.width(); ++i) {
        const double area = cells[static_cast<std::size_t>(i)];
        if (area <= 0) continue;
        const int x = column(coverage_.x0() + i);
        weights_.push_back({x, y, area * density_.at(x, y)});
        covered += weights_.back().weight;
      }
    }
    if (!(covered > 0)) {
      weights_.resize(first);
      return false;
    }
    for (std::size_t i = first; i < weights_.size(); ++i) weights_[i].weight *= solid_angle / covered;
    total_ += solid_angle;
    return true;
  }

  void add_point(MapPoint point, double solid_angle) {
    const int x = column(static_cast<int>(std::floor(point.x)));
    const int y = std::clamp(static_cast<int>(point.y), 0, source_.shape.height - 1);
    weights_.push_back({x, y, solid_angle});
    total_ += solid_angle;
  }

  int column(int x) const {
    const int width = source_.shape.width;
    if (source_.shape.mapping != Mapping::equirectangular) return std::clamp(x, 0, width - 1);
    return ((x % width) + width) % width;
  }

  const MapSource& source_;
  const DensityTable& density_;
  MapShape target_;
  int columns_;
  int middle_, min_depth_, max_depth_;
  int row_ = -2;
  std::vector<MapPoint> above_, below_;
  CellCoverage coverage_;
  std::vector<TexelWeight> weights_;
  double total_ = 0;
};

}  // namespace welkin
