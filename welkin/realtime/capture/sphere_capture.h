#pragma once
#include <welkin/realtime/capture/gpu_sky.h>
#include <welkin/realtime/capture/surroundings.h>
#include <welkin/realtime/gpu_environment.h>
#include <welkin/sphere/mapping.h>

// All that is seen from a point, drawn each frame into a cube map or into two paraboloids.

namespace welkin {

enum class CaptureInput {
  cube,        ///< six perspective pictures
  paraboloid,  ///< two paraboloids, each texel the mean of four look-ups in the cube: exact but for resampling
  paraboloid_warped,  ///< two paraboloids drawn at once by mapping vertices: as published, wrong for large triangles
};

struct CaptureSky {
  int kind = 0;  ///< 0: the environment's map, 1: `day`
  const GpuEnvironment* environment = nullptr;
  GpuSky day;
};

/// What surroundings are lit by, besides their flares: a cube map of irradiance times `scale`.
struct CaptureAmbient {
  const GlTexture* irradiance = nullptr;
  float scale = 0;
};

class SphereCapture {
 public:
  /// `size` texels along an edge of the cube and across each paraboloid. RGBA16F; the cube has a full mip chain, of which capture() fills level 0.
  SphereCapture(CaptureInput input, int size);

  void capture(const Surroundings& surroundings, const CaptureSky& sky, const CaptureAmbient& ambient,
               const Fullscreen& fullscreen);

  CaptureInput input() const { return input_; }
  int size() const { return size_; }
  int levels() const { return levels_; }
  const GlTexture& cube() const { return cube_; }  ///< not drawn to for paraboloid_warped: see need_cube()
  /// What is projected: the cube, or both paraboloids side by side in the layout of Mapping::dual_paraboloid.
  const GlTexture& map() const { return input_ == CaptureInput::cube ? cube_ : paraboloids_.colors[0]; }
  MapShape shape() const;
  /// Read back. The paraboloids' texels outside the discs are what lies beyond the rim.
  SphereMap read_map() const;
  /// The radiance as a cube: of warped paraboloids by resampling.
  Cube read_as_cube() const;

 private:
  void draw_cube(const Surroundings& surroundings, const CaptureSky& sky, const CaptureAmbient& ambient,
                 const Fullscreen& fullscreen);
  void draw_warped(const Surroundings& surroundings, const CaptureSky& sky, const CaptureAmbient& ambient,
                   const Fullscreen& fullscreen);
  void draw_sky(const Program& program, const CaptureSky& sky, const Fullscreen& fullscreen) const;

  CaptureInput input_;
  int size_, levels_;
  GlTexture cube_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
  RenderTarget paraboloids_;
  Program surroundings_, sky_, surroundings_warped_, sky_warped_, from_cube_;
};

/// Draws surroundings with a program that ends in surroundings.frag; for paraboloids the view's matrices do not matter.
void draw_surroundings(const Program& program, const Surroundings& surroundings,
                       const CaptureAmbient& ambient, const View& view);

}  // namespace welkin
