#include <welkin/envmap/environment.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/sphere/cube_layout.h>
#include <welkin/sphere/orientation.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

// The map as it comes, in its own mapping.
SphereMap map_of(LoadedImage loaded, std::string_view input, const EnvironmentOptions& options,
                 Environment& environment) {
  environment.warnings = std::move(loaded.warnings);
  environment.description = loaded.format;
  if (loaded.is_cube()) return sphere_map_from_cube(std::move(loaded.cube.levels.front()));
  Image& flat = loaded.flat;
  const auto guess = guess_flat_content(flat.width, flat.height);
  const Mapping mapping = options.mapping ? *options.mapping
                          : guess         ? guess->mapping
                                          : Mapping::equirectangular;
  if (!options.mapping && !guess)
    throw Error(
        input,
        fmt::format("{} x {} is neither 2:1 (equirectangular) nor a cube cross or strip; say what it is "
                    "with --mapping",
                    flat.width, flat.height));
  if (mapping == Mapping::cube) {
    if (!guess || !guess->layout)
      throw Error(input, fmt::format("{} x {} is no cube cross or strip", flat.width, flat.height));
    return sphere_map_from_cube(cube_from_layout(flat, *guess->layout));
  }
  return {mapping, std::move(flat)};
}

void check_shape(std::string_view input, const SphereMap& map, bool given) {
  // An equirectangular map of other proportions still covers the sphere, but nobody means that by accident.
  if (map.mapping == Mapping::equirectangular && !given && map.image.width != 2 * map.image.height)
    throw Error(input, fmt::format("{} x {} is not 2:1; say --mapping equirectangular if it is meant",
                                   map.image.width, map.image.height));
  try {
    check_map_shape(map.shape());
  } catch (const Error& error) {
    throw Error(input, error.what());
  }
}

// A finer map than its source, so that resampling loses nothing: a cube of N has 4N texels around its equator.
MapShape equirect_shape(const MapShape& shape) {
  const int across = std::min(shape.width, shape.height);
  return map_shape(Mapping::equirectangular, std::max(1, 2 * across));
}

SphereMap read_map(std::string_view input, const EnvironmentOptions& options, Environment& environment) {
  if (!is_sky_spec(input)) return map_of(load_image(std::string(input)), input, options, environment);
  environment.description = "built-in sky";
  return {Mapping::equirectangular, make_sky(parse_sky(input))};
}

Environment finish(SphereMap map, std::string_view input, const EnvironmentOptions& options,
                   Environment environment) {
  environment.source = std::string(input);
  check_shape(input, map, options.mapping.has_value());
  environment.description = fmt::format("{} {} x {}, {}", mapping_name(map.mapping), map.image.width,
                                        map.image.height, environment.description);
  environment.faults = repair_faults(map.image.pixels, options.faults, input);
  if (environment.faults.total() > 0)
    environment.warnings.push_back(fmt::format("repaired {} NaN, {} infinite and {} negative values",
                                               environment.faults.nan, environment.faults.infinite,
                                               environment.faults.negative));
  const auto [smallest, largest] = std::minmax_element(map.image.pixels.begin(), map.image.pixels.end());
  environment.smallest = *smallest;
  environment.largest = *largest;
  if (environment.largest <= 0) throw Error(input, "is black all over");
  // Irradiance, and what filters make of the map, must not leave float.
  if (environment.largest > 1e30f)
    throw Error(input, fmt::format("holds values up to {:.3g}; scale it below 1e30",
                                   static_cast<double>(environment.largest)));
  if (options.mirror) map = mirrored(map);
  if (std::fmod(options.rotate_degrees, 360.0) != 0) map = rotated_about_y(map, options.rotate_degrees);
  if (map.mapping != Mapping::equirectangular) map = resample(map, equirect_shape(map.shape()));
  environment.radiance = std::move(map.image);
  return environment;
}

// Errors of the readers name the input already, those of skies, rotations and layouts do not.
template <class Make>
Environment with_name(std::string_view input, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    if (!error.path().empty()) throw;
    throw Error(input, error.what());
  }
}

}  // namespace

Environment load_environment(std::string_view input, const EnvironmentOptions& options) {
  return with_name(input, [&] {
    Environment environment;
    SphereMap map = read_map(input, options, environment);
    return finish(std::move(map), input, options, std::move(environment));
  });
}

Environment make_environment(LoadedImage loaded, std::string_view name, const EnvironmentOptions& options) {
  return with_name(name, [&] {
    Environment environment;
    SphereMap map = map_of(std::move(loaded), name, options, environment);
    return finish(std::move(map), name, options, std::move(environment));
  });
}

}  // namespace welkin
