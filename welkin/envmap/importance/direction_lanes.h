#pragma once
#include <cstddef>

#include <welkin/envmap/importance/environment_sampler.h>

// Between directions and places of a map, 16 at a time: the same operations as one by one, so the same bits.

namespace welkin {

inline constexpr std::size_t direction_lanes = 16;

/// Place of a direction, which need not have unit length.
EnvironmentPlace place_in_map(Vec3f direction);

struct PlaceLanes {
  float x[direction_lanes] = {}, y[direction_lanes] = {}, z[direction_lanes] = {};  ///< directions, in
  float s[direction_lanes], t[direction_lanes], sine[direction_lanes];              ///< out
};
/// All lanes, used or not.
void places_in_map(PlaceLanes& lanes);

/// A direction by its azimuth in turns from -X and h = sin^2(theta / 2) of its angle to the upper (pole = 1) or lower
/// (pole = -1) pole.
Vec3f direction_by_height(float turns, float h, float pole);

struct HeightLanes {
  float turns[direction_lanes] = {}, h[direction_lanes] = {}, pole[direction_lanes] = {};  ///< in
  float x[direction_lanes], y[direction_lanes], z[direction_lanes];  ///< directions, out
};
void directions_by_height(HeightLanes& lanes);

}  // namespace welkin
