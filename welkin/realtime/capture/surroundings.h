#pragma once
#include <vector>

#include <welkin/realtime/gpu_scene.h>

// What moves around the object that is lit: built here for any scene, as a function of time alone, so that a frame can be drawn again.

namespace welkin {

enum class SurroundingsKind {
  none,
  flares,    ///< flares tossed over a place without walls
  room,      ///< a room with a window and a hole in its ceiling, flares tossed into it
  carousel,  ///< coloured blocks and lamps that go round
};

/// A burning ball: a sphere that emits evenly.
struct Flare {
  Vec3f centre;
  float radius = 0;
  Rgb radiance;  ///< W/(sr m^2); black when it has gone out
};

/// Where the flares are. They start at the edge of a disc of `reach` around `centre` on a floor at height `floor`, one after the other, fly as things thrown do,
/// bounce thrice with half the speed, burn for 3 s and are thrown again from elsewhere.
struct FlareField {
  Vec3f centre;
  float reach = 1, floor = 0;
  float radiance = 1;
};
inline constexpr int flare_count = 4;
std::vector<Flare> flares_at(const FlareField& field, double time_seconds);

/// In OpenGL. Walls and floor are cut into patches x patches quads each (a paraboloid's vertices bend what lies between them wrongly).
class Surroundings {
 public:
  Surroundings(SurroundingsKind kind, const Bounds& about, int patches);

  void move_to(double time_seconds, float flare_radiance);
  const GpuScene& scene() const { return scene_; }
  const std::vector<Flare>& flares() const { return flares_; }
  Vec3f probe() const { return probe_; }         ///< where it is captured from: the middle of `about`
  float reach_metres() const { return reach_; }  ///< of the farthest thing from there, at least

 private:
  void move_carousel(double time_seconds);

  SurroundingsKind kind_;
  Vec3f probe_;
  float size_ = 1, floor_ = 0, reach_ = 1;
  std::vector<Flare> flares_;
  GpuScene scene_;
};

/// What the capture and the picture use to light surroundings: irradiance of the flares and of a cube map. Sets the uniforms of
/// surroundings.frag.
void set_flares(const Program& program, const std::vector<Flare>& flares);

}  // namespace welkin
