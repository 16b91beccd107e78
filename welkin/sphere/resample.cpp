#include <welkin/sphere/resample.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <numbers>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/direction_index.h>
#include <welkin/sphere/patch_mean.h>

namespace welkin {
namespace {

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
bool interpolate(const MapSource& source, const DirectionIndex& index, Vec3 direction, double radius,
                 ChannelSum& mean) {
  const float scale = static_cast<float>(1 / (radius * radius));
  const float dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
              dz = static_cast<float>(direction.z);
  ChannelSum sum{};
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
double smooth_share(const MapSource& source, MapShape target, Vec3 direction) {
  const double ratio =
      map_spacing(source.shape, source.from_target * direction) / map_spacing(target, direction);
  const double t = std::clamp((ratio - 1.25) / 0.75, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

bool any_magnified(const MapSource& source, MapShape target) {
  for (int y = 0; y < target.height; ++y) {
    for (int x = 0; x < target.width; x += std::max(1, target.width / 64)) {
      if (smooth_share(source, target, map_texel_direction(target, x, y)) > 0) return true;
    }
  }
  return false;
}

void resample_rows(const MapSource& source, const DensityTable& density, const DirectionIndex* index,
                   int begin, int end, SphereMap& result) {
  constexpr double kernel_radius = 1.7;
  const MapShape target = result.shape();
  PatchMean patch_mean(source, density, target);
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (!map_covers(target, x, y) && map_texel_solid_angle(target, x, y) <= 0) continue;
      const Vec3 direction = map_texel_direction(target, x, y);
      double share = index != nullptr ? smooth_share(source, target, direction) : 0;
      ChannelSum smooth{};
      const Vec3 wanted = source.from_target * direction;
      const double radius = kernel_radius * map_spacing(source.shape, wanted);
      if (share > 0 && !interpolate(source, *index, wanted, radius, smooth)) share = 0;
      const ChannelSum box = share < 1 ? patch_mean(x, y) : ChannelSum{};
      float* texel = result.image.at(x, y);
      for (int c = 0; c < source.channels; ++c) {
        const auto k = static_cast<std::size_t>(c);
        texel[c] = static_cast<float>(box[k] + share * (smooth[k] - box[k]));
      }
    }
  }
}

std::vector<double> energy(const MapSource& source) {
  std::vector<double> total(static_cast<std::size_t>(source.channels));
  const auto add_rows = [&](ChannelSum& sum, std::size_t begin, std::size_t end) {
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
  for (const ChannelSum& part :
       parallel_partials<ChannelSum>(static_cast<std::size_t>(source.shape.height), 16, add_rows)) {
    for (std::size_t c = 0; c < total.size(); ++c) total[c] += part[c];
  }
  return total;
}

// A factor far from 1 can only come from a channel whose energy nearly cancels (negative values): leave that alone.
void put_energy_back(const std::vector<double>& wanted, SphereMap& map, bool apply, ResampleReport* report) {
  const std::vector<double> found =
      energy({map.shape(), map.image.channels, map.image.pixels.data(), {}, {}});
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

void check_orthogonal(const Mat3& orientation) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = dot(orientation.rows[i], orientation.rows[j]);
      if (!(std::abs(product - (i == j ? 1 : 0)) < 1e-6))  // also where it is NaN
        throw Error("the orientation matrix is not orthogonal");
    }
  }
}

SphereMap resample(MapSource source, MapShape target, const ResampleOptions& options,
                   ResampleReport* report) {
  check_map_shape(source.shape);
  check_orthogonal(options.orientation);
  source.row_skew = row_skews(source.shape);
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
  if (options.interpolate && any_magnified(source, target)) index = std::make_unique<DirectionIndex>(from);
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
  return energy({map.shape(), map.image.channels, map.image.pixels.data(), {}, {}});
}

SphereMap resample(const SphereMap& source, MapShape target, const ResampleOptions& options,
                   ResampleReport* report) {
  return resample(MapSource{source.shape(),
                            source.image.channels,
                            source.image.pixels.data(),
                            transposed(options.orientation),
                            {}},
                  target, options, report);
}

Cube equirect_to_cube(const Image& equirect, int size, const ResampleOptions& options) {
  const MapSource source{{Mapping::equirectangular, equirect.width, equirect.height},
                         equirect.channels,
                         equirect.pixels.data(),
                         transposed(options.orientation),
                         {}};
  return cube_from_sphere_map(resample(source, map_shape(Mapping::cube, size), options, nullptr));
}

Image cube_to_equirect(const Cube& cube, int width, int height, const ResampleOptions& options) {
  const MapSource source{map_shape(Mapping::cube, cube.size),
                         cube.channels,
                         cube.texels.data(),
                         transposed(options.orientation),
                         {}};
  return resample(source, {Mapping::equirectangular, width, height}, options, nullptr).image;
}

}  // namespace welkin
