#pragma once
#include <cstdint>

#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>
#include <welkin/realtime/technique.h>

// Lobes cos^N about any axis, each pixel with an N of its own, from one chain of maps (McAllister, Lastra & Heidrich
// 2002): what Phong, Lafortune and Fresnel-blended materials look up.
//
// Level law: level k of the chain is the environment filtered with cos^N, N = 1024, 256, 64, 16, 4, 1 and, at the
// last level, 0 (the mean over a hemisphere). Between two levels 1 / (N + 2) is linear (lafortune_level), because the mean
// of 1 - cos under cos^N is 1 / (N + 2): so the blend has the right mean cosine. Sharper lobes blend level 0 with the environment itself.
//
// Moments. A surface reflects the integral of (r.l)^N (n.l) over the hemisphere above it, which is no lobe about r: the
// cosine and the horizon pull it towards the normal. It depends on two numbers, n.r and N. So its first two moments are
// tabulated, and the look-up goes to the one lobe that has them: energy (degree 0), axis and width (degree 1).
// The result is exact for light that has nothing above degree 1. As published the cosine is n.r, outside.

namespace welkin {

/// The lobe with the moments of (N + 1) / (2 pi) max(0, r.l)^N max(0, n.l) over directions l.
struct MomentLobe {
  double energy = 0;       ///< the integral
  double lean = 0;         ///< its axis is r + lean (n - (n.r) r), not of unit length
  double mean_cosine = 0;  ///< about its axis: cos^M has (M + 1) / (M + 2)
};

/// cos_axis = n.r in [-1, 1]; exponent N >= 0. Quadrature to about 1e-4.
MomentLobe moment_lobe(double cos_axis, double exponent);

/// The chain and the table in OpenGL, made when an environment is first drawn with.
class PowerLobeMaps {
 public:
  /// Makes the chain anew if the environment is another one.
  void prepare(const Frame& frame);
  /// Sets the uniforms of power_lobe.glsl; takes two units from `first_unit`.
  void bind(const Program& program, int first_unit) const;

 private:
  std::uint64_t made_for_ = 0;  // GpuEnvironment::upload
  GlTexture chain_, moments_;
  int levels_ = 0;
};

}  // namespace welkin
