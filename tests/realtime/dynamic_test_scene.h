#pragma once
#include <welkin/realtime/capture/sphere_capture.h>
#include <welkin/realtime/renderer.h>

// What the tests of captured light share: a small light, surroundings around the unit box, brute force over a cube's texels.

namespace welkin {

/// Maps of a sky of noise with some lamps, 64 x 32.
std::shared_ptr<const EnvironmentData> noise_light();

/// A capture and what it was made of.
struct CapturedRoom {
  GpuEnvironment environment;
  Surroundings surroundings;
  SphereCapture capture;

  CapturedRoom(SurroundingsKind kind, CaptureInput input, int size, int patches, double time_seconds);
};

/// The sum over all texels of a cube of radiance times `kernel(cosine)` times solid angle.
std::array<double, 3> sum_over_cube(const Cube& cube, Vec3 axis, const ZonalKernel& kernel);

/// A unit sphere of one material seen by an orthographic camera from +Z, its picture just around it.
Scene lone_sphere(const Material& material);

/// Its normal at a pixel of a picture of size x size, or nothing outside; rim pixels count as outside.
std::optional<Vec3> lone_sphere_normal(int size, int x, int y);

}  // namespace welkin
