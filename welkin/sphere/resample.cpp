#include <welkin/sphere/resample.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sphere/cube_mirrors.h>
#include <welkin/sphere/texel_weights.h>

namespace welkin {
namespace {

void resample_rows(const ResampleGeometry& geometry, int begin, int end, SphereMap& result) {
  const MapSource& source = geometry.source();
  const MapShape target = geometry.target();
  TexelWeights weights(geometry, target.width);
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < target.width; ++x) {
      if (!map_covers(target, x, y) && map_texel_solid_angle(target, x, y) <= 0) continue;
      ChannelSum sum{};
      for (const TexelWeight& w : weights(x, y)) {
        const float* texel = source.at(w.x, w.y);
        for (int c = 0; c < source.channels; ++c) sum[static_cast<std::size_t>(c)] += w.weight * texel[c];
      }
      float* texel = result.image.at(x, y);
      for (int c = 0; c < source.channels; ++c)
        texel[c] = static_cast<float>(sum[static_cast<std::size_t>(c)]);
    }
  }
}

// Sums of the samples with equal index modulo `lanes`, a multiple of every number of channels: 24 chains of additions
// that the compiler lays side by side.
constexpr std::size_t lanes = 24;

WELKIN_TARGET_CLONES
void add_samples(const float* samples, std::size_t count, double* sums) {
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += static_cast<double>(samples[i + k]);
  }
  for (std::size_t k = 0; i < count; ++i, ++k) sums[k] += static_cast<double>(samples[i]);
}

// A row of an equirectangular map, where all texels have the same solid angle.
void add_equal_row(const MapSource& source, int y, ChannelSum& sum) {
  double sums[lanes] = {};
  const auto channels = static_cast<std::size_t>(source.channels);
  add_samples(source.at(0, y), static_cast<std::size_t>(source.shape.width) * channels, sums);
  const double solid_angle = map_texel_solid_angle(source.shape, 0, y);
  for (std::size_t k = 0; k < lanes; ++k) sum[k % channels] += solid_angle * sums[k];
}

void add_row(const MapSource& source, int y, const std::vector<double>& solid_angles, ChannelSum& sum) {
  for (int x = 0; x < source.shape.width; ++x) {
    const double solid_angle = solid_angles[static_cast<std::size_t>(x)];
    for (int c = 0; c < source.channels; ++c)
      sum[static_cast<std::size_t>(c)] += solid_angle * source.at(x, y)[c];
  }
}

std::vector<double> energy(const MapSource& source) {
  std::vector<double> total(static_cast<std::size_t>(source.channels));
  const bool equal_rows = source.shape.mapping == Mapping::equirectangular;
  const int period = source.shape.mapping == Mapping::cube ? source.shape.width : source.shape.height;
  const auto add_rows = [&](ChannelSum& sum, std::size_t begin, std::size_t end) {
    std::vector<double> solid_angles;
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      if (equal_rows) {
        add_equal_row(source, y, sum);
        continue;
      }
      map_row_solid_angles(source.shape, y, solid_angles);
      for (int same = y; same < source.shape.height; same += period)  // each face of a cube
        add_row(source, same, solid_angles, sum);
    }
  };
  for (const ChannelSum& part :
       parallel_partials<ChannelSum>(static_cast<std::size_t>(period), 16, add_rows)) {
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
    for (std::size_t i = begin * row; i < end * row; i += wanted.size()) {
      for (std::size_t c = 0; c < wanted.size(); ++c) map.image.pixels[i + c] *= factor[c];
    }
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
  const ResampleGeometry geometry(source, target, options.interpolate);
  if (has_mirrors(from, target) && is_identity(options.orientation)) {
    resample_mirrored(geometry, result);
  } else {
    parallel_for(static_cast<std::size_t>(target.height), 4, [&](std::size_t begin, std::size_t end) {
      resample_rows(geometry, static_cast<int>(begin), static_cast<int>(end), result);
    });
  }
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
