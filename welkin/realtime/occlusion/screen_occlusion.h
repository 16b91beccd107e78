#pragma once
#include <string_view>

#include <welkin/realtime/occlusion/geometry_pass.h>
#include <welkin/realtime/pass_timer.h>

// Ambient occlusion from what the camera sees: a pass that any technique may use. Openness is the cosine-weighted share of the
// hemisphere about the shading normal in which nothing is nearer than `radius_metres`; 1 is open.

namespace welkin {

enum class OcclusionMethod {
  sphere,      ///< Mittring 2007 (Crytek): points in a ball; flat walls come out half open
  hemisphere,  ///< points on the side of the normal, with `falloff` a range check
};
inline constexpr int occlusion_methods = 2;

struct OcclusionOptions {
  OcclusionMethod method = OcclusionMethod::hemisphere;
  float radius_metres = 0.5f;         ///< > 0
  float largest_radius_pixels = 256;  ///< the search never goes farther in the picture
  int samples = 16;                   ///< depth reads of a pixel, 1 to 256
  float falloff = 0;                  ///< 0 to 1: the last part of the radius over which occluders fade
};

/// The scene's geometry and its openness for one size of picture.
class ScreenOcclusion {
 public:
  /// Draws geometry and openness. Leaves one of its own framebuffers bound.
  void draw(const GpuScene& scene, const View& view, const OcclusionOptions& options,
            const Fullscreen& fullscreen, PassTimer& timer);
  /// rgba16f: bent normal (mean open direction; world, unit; the normal where the method has none) and openness.
  const RenderTarget& openness() const { return openness_; }
  const GeometryPass& geometry() const { return geometry_; }

 private:
  const Program& program(OcclusionMethod method);
  GeometryPass geometry_;
  RenderTarget openness_;
  Program programs_[occlusion_methods];
};

/// Binds the openness to `unit` for a fragment shader that includes screen_occlusion.glsl.
void set_screen_occlusion(const Program& program, const ScreenOcclusion& occlusion, int unit);

}  // namespace welkin
