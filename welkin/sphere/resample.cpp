#include <welkin/sphere/resample.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cell_coverage.h>
#include <welkin/sphere/direction_index.h>

namespace welkin {
namespace {

using Sum = std::array<double, 4>;

// Texels of someone else's image or cube.
struct Source {
  MapShape shape;
  int channels = 3;
  const float* pixels = nullptr;
  Mat3 from_target;  // turns a direction of the target into the source's frame

  MapPoint point(Vec3 target_direction) const { return map_point(shape, from_target * target_direction); }

  const float* at(int x, int y) const {
    return pixels + (static_cast<std::size_t>(y) * shape.width + x) * channels;
  }
};

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

// The mean of the source over the patch of a target texel. The patch is a quadrilateral between its corners' images
// on the source's grid; where that is a bad picture of it (it crosses a cut, or its edges are curved by more than
// flat_enough texels) it is quartered, and at the last depth represented by its middle.
class PatchMean {
 public:
  PatchMean(const Source& source, const DensityTable& density, MapShape target)
      : source_(source), density_(density), target_(target) {
    const double source_texels = static_cast<double>(source.shape.width) * source.shape.height;
    const double ratio = std::sqrt(source_texels / target.width / target.height);
    middle_ = target.mapping == Mapping::dual_paraboloid ? target.height : target.width;
    max_depth_ = 5 + std::max(0, static_cast<int>(std::ceil(std::log2(ratio))));
  }

  Sum operator()(int x, int y) {
    sum_ = {};
    weight_ = 0;
    if (!add_whole(x, y)) gather(x, y, {0, 0}, 1, 0);
    if (weight_ <= 0) add_point(source_.point(map_texel_direction(target_, x, y)), 1);
    for (double& value : sum_) value /= weight_;
    return sum_;
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
    for (int x = 0; x < target_.width; ++x) {
      corners.push_back(source_.point(map_texel_direction(target_, x, y, 0, fy)));
      if (x + 1 == middle_ || x + 1 == target_.width) {
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
    if (covered == 4) {
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
    Sum sum{};
    double weight = 0;
    for (int row = 0; row < coverage_.height(); ++row) {
      const int y = std::min(coverage_.y0() + row, source_.shape.height - 1);
      const auto cells = coverage_.row(row);
      for (int i = 0; i < coverage_.width(); ++i) {
        const double area = cells[static_cast<std::size_t>(i)];
        if (area <= 0) continue;
        const int x = column(coverage_.x0() + i);
        const double w = area * density_.at(x, y);
        const float* texel = source_.at(x, y);
        for (int c = 0; c < source_.channels; ++c) sum[static_cast<std::size_t>(c)] += w * texel[c];
        weight += w;
      }
    }
    if (!(weight > 0)) return false;
    for (std::size_t c = 0; c < sum.size(); ++c) sum_[c] += solid_angle / weight * sum[c];
    weight_ += solid_angle;
    return true;
  }

  void add_point(MapPoint point, double solid_angle) {
    const int x = column(static_cast<int>(std::floor(point.x)));
    const int y = std::clamp(static_cast<int>(point.y), 0, source_.shape.height - 1);
    const float* texel = source_.at(x, y);
    for (int c = 0; c < source_.channels; ++c) sum_[static_cast<std::size_t>(c)] += solid_angle * texel[c];
    weight_ += solid_angle;
  }

  int column(int x) const {
    const int width = source_.shape.width;
    if (source_.shape.mapping != Mapping::equirectangular) return std::clamp(x, 0, width - 1);
    return ((x % width) + width) % width;
  }

  const Source& source_;
  const DensityTable& density_;
  MapShape target_;
  int middle_, max_depth_;
  int row_ = -2;
  std::vector<MapPoint> above_, below_;
  CellCoverage coverage_;
  Sum sum_{};
  double weight_ = 0;
};

// The widest distance (radians) between neighbouring texel centres around a direction, made smooth where the exact
// figure has kinks (face edges, folds, the rim), because the width of the interpolation kernel follows it.
double map_spacing(MapShape shape, Vec3 d) {
  const double n = shape.height;
  switch (shape.mapping) {
    case Mapping::equirectangular: return std::numbers::pi * std::max(1.0 / shape.height, 2.0 / shape.width);
    case Mapping::cube: {
      const double x2 = d.x * d.x, y2 = d.y * d.y, z2 = d.z * d.z;
      const double sum8 = x2 * x2 * x2 * x2 + y2 * y2 * y2 * y2 + z2 * z2 * z2 * z2;
      const double root8 = std::sqrt(std::sqrt(std::sqrt(sum8)));
      return 2.0 / shape.width * root8 * std::sqrt(root8);  // (x^8 + y^8 + z^8)^(3/16)
    }
    case Mapping::dual_paraboloid: return 2 / n * (1 + std::sqrt(d.z * d.z + 0.01));
    case Mapping::mirror_ball: return 4 / n / std::sqrt((1 + d.z) / 2 + 1 / n);
    default: {
      const auto soft = [](double v) { return std::sqrt(v * v + 0.01); };
      return 2 / n * std::pow(soft(d.x) + soft(d.y) + soft(d.z), 1.5);
    }
  }
}

// The smooth interpolation; false where no texel is within reach.
bool interpolate(const Source& source, const DirectionIndex& index, Vec3 direction, double radius,
                 Sum& mean) {
  const float scale = static_cast<float>(1 / (radius * radius));
  const float dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
              dz = static_cast<float>(direction.z);
  Sum sum{};
  double total = 0;
  index.visit_near(direction, radius, [&](std::span<const DirectionIndex::Entry> entries) {
    for (const DirectionIndex::Entry& e : entries) {
      const float x = e.x - dx, y = e.y - dy, z = e.z - dz;
      const float rest = 1 - scale * (x * x + y * y + z * z);
      if (rest <= 0) continue;
      const double weight = static_cast<double>(rest * rest * rest * e.solid_angle);
      const float* texel = source.pixels + static_cast<std::size_t>(e.texel) * source.channels;
      for (int c = 0; c < source.channels; ++c) sum[static_cast<std::size_t>(c)] += weight * texel[c];
      total += weight;
    }
  });
  if (!(total > 0)) return false;
  for (std::size_t c = 0; c < sum.size(); ++c) mean[c] = sum[c] / total;
  return true;
}

// How much of the interpolation to use: none while the target's texels are wider than 4/5 of the source's, all of it
// from twice as fine up.
double smooth_share(const Source& source, MapShape target, Vec3 direction) {
  const double ratio =
      map_spacing(source.shape, source.from_target * direction) / map_spacing(target, direction);
  const double t = std::clamp((ratio - 1.25) / 0.75, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

bool any_magnified(const Source& source, MapShape target) {
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; x += std::max(1, target.width / 64)) {
      if (smooth_share(source, target, map_texel_direction(target, x, y)) > 0) return true;
    }
  }
  return false;
}

void resample_rows(const Source& source, const DensityTable& density, const DirectionIndex* index, int begin,
                   int end, SphereMap& result) {
  constexpr double kernel_radius = 1.7;
  const MapShape target = result.shape();
  PatchMean patch_mean(source, density, target);
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (!map_covers(target, x, y) && map_texel_solid_angle(target, x, y) <= 0) continue;
      const Vec3 direction = map_texel_direction(target, x, y);
      double share = index != nullptr ? smooth_share(source, target, direction) : 0;
      Sum smooth{};
      const Vec3 wanted = source.from_target * direction;
      const double radius = kernel_radius * map_spacing(source.shape, wanted);
      if (share > 0 && !interpolate(source, *index, wanted, radius, smooth)) share = 0;
      const Sum box = share < 1 ? patch_mean(x, y) : Sum{};
      float* texel = result.image.at(x, y);
      for (int c = 0; c < source.channels; ++c) {
        const auto k = static_cast<std::size_t>(c);
        texel[c] = static_cast<float>(box[k] + share * (smooth[k] - box[k]));
      }
    }
  }
}

std::vector<double> energy(const Source& source) {
  std::vector<double> total(static_cast<std::size_t>(source.channels));
  const auto add_rows = [&](Sum& sum, std::size_t begin, std::size_t end) {
    std::vector<double> solid_angles;
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      map_row_solid_angles(source.shape, y, solid_angles);
      for (int x = 0; x < source.shape.width; ++x) {
        const double solid_angle = solid_angles[static_cast<std::size_t>(x)];
        for (int c = 0; c < source.channels; ++c) {
          sum[static_cast<std::size_t>(c)] += solid_angle * source.at(x, y)[c];
        }
      }
    }
  };
  for (const Sum& part :
       parallel_partials<Sum>(static_cast<std::size_t>(source.shape.height), 16, add_rows)) {
    for (std::size_t c = 0; c < total.size(); ++c) total[c] += part[c];
  }
  return total;
}

// A factor far from 1 can only come from a channel whose energy nearly cancels (negative values): leave that alone.
void put_energy_back(const std::vector<double>& wanted, SphereMap& map, bool apply, ResampleReport* report) {
  const std::vector<double> found = energy({map.shape(), map.image.channels, map.image.pixels.data(), {}});
  std::vector<float> factor(wanted.size(), 1.0f);
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    const double ratio = wanted[c] != 0 ? found[c] / wanted[c] : 1;
    if (report != nullptr) report->raw_energy_ratio.push_back(ratio);
    if (apply && ratio > 0.5 && ratio < 2) factor[c] = static_cast<float>(1 / ratio);
  }
  const std::size_t row = static_cast<std::size_t>(map.image.width) * wanted.size();
  parallel_for(static_cast<std::size_t>(map.image.height), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * row; i < end * row; ++i) map.image.pixels[i] *= factor[i % wanted.size()];
  });
}

SphereMap resample(const Source& source, MapShape target, const ResampleOptions& options,
                   ResampleReport* report) {
  check_map_shape(source.shape);
  if (source.channels < 1 || source.channels > 4)
    throw Error("only maps of 1 to 4 channels can be resampled");
  SphereMap result = make_sphere_map(target, source.channels);
  const MapShape from = source.shape;
  if (is_identity(options.orientation) && from.mapping == target.mapping && from.width == target.width &&
      from.height == target.height) {
    std::copy_n(source.pixels, result.image.pixels.size(), result.image.pixels.begin());
    if (report != nullptr) report->raw_energy_ratio.assign(static_cast<std::size_t>(source.channels), 1.0);
    return result;
  }
  const DensityTable density(from);
  std::unique_ptr<DirectionIndex> index;
  if (any_magnified(source, target)) index = std::make_unique<DirectionIndex>(from);
  parallel_for(static_cast<std::size_t>(target.height), 4, [&](std::size_t begin, std::size_t end) {
    resample_rows(source, density, index.get(), static_cast<int>(begin), static_cast<int>(end), result);
  });
  if (options.keep_energy || report != nullptr) {
    put_energy_back(energy(source), result, options.keep_energy, report);
  }
  return result;
}

}  // namespace

std::vector<double> map_energy(const SphereMap& map) {
  return energy({map.shape(), map.image.channels, map.image.pixels.data(), {}});
}

SphereMap resample(const SphereMap& source, MapShape target, const ResampleOptions& options,
                   ResampleReport* report) {
  return resample(Source{source.shape(), source.image.channels, source.image.pixels.data(),
                         transposed(options.orientation)},
                  target, options, report);
}

Cube equirect_to_cube(const Image& equirect, int size, const ResampleOptions& options) {
  const Source source{{Mapping::equirectangular, equirect.width, equirect.height},
                      equirect.channels,
                      equirect.pixels.data(),
                      transposed(options.orientation)};
  return cube_from_sphere_map(resample(source, map_shape(Mapping::cube, size), options, nullptr));
}

Image cube_to_equirect(const Cube& cube, int width, int height, const ResampleOptions& options) {
  const Source source{map_shape(Mapping::cube, cube.size), cube.channels, cube.texels.data(),
                      transposed(options.orientation)};
  return resample(source, {Mapping::equirectangular, width, height}, options, nullptr).image;
}

}  // namespace welkin
