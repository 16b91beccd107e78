#include <welkin/envmap/importance/direction_lanes.h>

#include <cmath>

#include <welkin/geometry/fast_angles.h>
#include <welkin/parallel/target_clones.h>

// Compiled without contraction of products and sums: every instruction set gives the same bits.

namespace welkin {
namespace {

inline EnvironmentPlace place_of(float x, float y, float z) {
  const float sine = std::sqrt(x * x + z * z);
  const float s = atan2_turns(z, x) + 0.5f;
  return {s < 1 ? s : 0, 2 * atan2_turns(sine, y), sine};
}

inline Vec3f direction_of(float turns, float h, float pole) {
  const Vec2f around = cos_sin_turns(turns - 0.5f);
  const float sine = 2 * std::sqrt(h * (1 - h));
  return {sine * around.x, pole * (1 - 2 * h), sine * around.y};
}

}  // namespace

EnvironmentPlace place_in_map(Vec3f direction) { return place_of(direction.x, direction.y, direction.z); }

WELKIN_TARGET_CLONES void places_in_map(PlaceLanes& lanes) {
  for (std::size_t i = 0; i < direction_lanes; ++i) {
    const EnvironmentPlace place = place_of(lanes.x[i], lanes.y[i], lanes.z[i]);
    lanes.s[i] = place.s;
    lanes.t[i] = place.t;
    lanes.sine[i] = place.sine;
  }
}

Vec3f direction_by_height(float turns, float h, float pole) { return direction_of(turns, h, pole); }

WELKIN_TARGET_CLONES void directions_by_height(HeightLanes& lanes) {
  for (std::size_t i = 0; i < direction_lanes; ++i) {
    const Vec3f direction = direction_of(lanes.turns[i], lanes.h[i], lanes.pole[i]);
    lanes.x[i] = direction.x;
    lanes.y[i] = direction.y;
    lanes.z[i] = direction.z;
  }
}

}  // namespace welkin
