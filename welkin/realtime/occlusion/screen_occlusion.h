#pragma once
#include <welkin/realtime/occlusion/geometry_pass.h>
#include <welkin/realtime/pass_timer.h>

// Ambient occlusion from what the camera sees: a pass that any technique may use. Openness is the cosine-weighted share of the
// hemisphere about the shading normal in which nothing is nearer than `radius_metres`; 1 is open. docs/realtime-occlusion.md.

namespace welkin {

enum class OcclusionMethod {
  sphere,              ///< Mittring 2007 (Crytek): points in a ball; flat walls come out half open
  hemisphere,          ///< Filion & McNaughton 2008: points on the side of the normal
  alchemy,             ///< McGuire et al. 2011: taps on surfaces
  sao,                 ///< McGuire, Mara & Luebke 2012: a spiral of taps, far ones from smaller levels
  gtao,                ///< Jimenez et al. 2016: horizons of slices
  visibility_bitmask,  ///< Therrien et al. 2023: 32 sectors of a slice
  horizon_sectors,     ///< our own: sectors of equal measure, taps that stand for pieces of surface
};
inline constexpr int occlusion_methods = 7;

struct OcclusionOptions {
  OcclusionMethod method = OcclusionMethod::horizon_sectors;
  float radius_metres = 0.5f;         ///< > 0
  float largest_radius_pixels = 256;  ///< the search never goes farther in the picture
  int samples = 16;                   ///< depth reads of a pixel, 1 to 256: methods without slices
  int slices = 2, steps = 4;          ///< methods with slices: 2 slices steps reads; both 1 to 64
  float step_power = 2;               ///< taps of a slice lie at radius u^step_power, u evenly spread
  float thickness_metres = 0.1f;      ///< of what is seen: visibility_bitmask, horizon_sectors
  float falloff = 0;    ///< 0 to 1: part of the radius over which far occluders fade: hemisphere, gtao
  float thin = 0;       ///< 0 to 1: how fast a horizon of gtao sinks behind a thin occluder
  float intensity = 1;  ///< of alchemy and sao
  bool denoise = true;  ///< cross-bilateral, over 5 x 5 pixels
  bool bent_normals =
      false;  ///< costs sector methods 32 evaluations a slice; hemisphere and gtao always have them
};

/// The denoiser's scale: where openness is expected to differ as much as the noise of 16 reads does, about 0.1. It changes by one over
/// about 0.3 radii off a plane (x) and 3 radii along it (y), both as parts of the radius, and over 3 radians of the normal (z).
inline constexpr Vec3f occlusion_noise_scale{0.03f, 0.3f, 0.3f};

/// The scene's geometry and its openness for one size of picture.
class ScreenOcclusion {
 public:
  /// Draws geometry and openness. Leaves one of its own framebuffers bound.
  void draw(const GpuScene& scene, const View& view, const OcclusionOptions& options,
            const Fullscreen& fullscreen, PassTimer& timer);
  /// rgba16f: cosine-weighted mean of the open directions (world, unit; the normal where the method has none or was not asked),
  /// and openness.
  const RenderTarget& openness() const { return openness_; }
  const GeometryPass& geometry() const { return geometry_; }

 private:
  const Program& program(const OcclusionOptions& options);
  void find_openness(const View& view, const OcclusionOptions& options, const Fullscreen& fullscreen);
  void draw_levels(const Fullscreen& fullscreen);
  void denoise(const View& view, const OcclusionOptions& options, const Fullscreen& fullscreen);

  GeometryPass geometry_;
  RenderTarget openness_, half_way_, levels_;
  Program level_program_, denoise_program_;
  Program programs_[2][occlusion_methods];  ///< [1]: with bent normals
};

/// Binds the openness to `unit` for a fragment shader that includes screen_occlusion.glsl.
void set_screen_occlusion(const Program& program, const ScreenOcclusion& occlusion, int unit);

}  // namespace welkin
