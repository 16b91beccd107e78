#pragma once
#include <optional>

#include <welkin/realtime/capture/lobe_cube.h>
#include <welkin/realtime/capture/sh_projector.h>
#include <welkin/realtime/capture/sphere_capture.h>
#include <welkin/realtime/technique.h>

// What the techniques that capture their light each frame share: surroundings that move, their capture, and the irradiance that comes of it.

namespace welkin {

struct DynamicLightOptions {
  SurroundingsKind around = SurroundingsKind::flares;
  int sky = 0;  ///< 0: the environment, 1: a day (sun_at)
  CaptureInput input = CaptureInput::cube;
  int size = 64;  ///< of the capture
  ShProjectionMethod projection = ShProjectionMethod::staged;
  int degree = 2;   ///< of the coefficients
  int bounces = 1;  ///< how often the surroundings are captured again, lit by what they were lit by before
  float flare_radiance = 150;
  int patches = 8;  ///< the walls are cut into patches x patches
};

class DynamicLight {
 public:
  /// Captures, projects and filters what is to be seen at frame.time_seconds. Makes anew what the options ask for.
  void update(const Frame& frame, const DynamicLightOptions& options);

  /// Draws the surroundings, and the day, into frame.target with alpha 0, where nothing nearer is. After the scene, with the same view.
  void draw_around(const Frame& frame, const View& view);
  /// The frame's view with a depth range that holds the surroundings too.
  View view_of(const Frame& frame) const;

  const SphereCapture& capture() const { return *capture_; }
  const ShProjector& projector() const { return *projector_; }
  const LobeCube& irradiance() const { return *irradiance_; }
  bool ready() const { return drawn_; }

 private:
  void prepare(const Frame& frame, const DynamicLightOptions& options);
  void capture_once(const Frame& frame, float ambient);

  DynamicLightOptions options_;
  Bounds about_;
  CaptureSky sky_;
  std::optional<Surroundings> surroundings_;
  std::optional<SphereCapture> capture_;
  std::optional<ShProjector> projector_;
  std::optional<LobeCube> irradiance_;
  Program around_, sky_program_;
  bool drawn_ = false;
};

}  // namespace welkin
