#pragma once
#include <span>

#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>

namespace welkin {

/// From coefficients to a cube map that is filtered by a lobe, one pass a face (King 2005, section 10.3.2). RGBA16F, one level.
class LobeCube {
 public:
  /// `factors[l]` is what the lobe multiplies degree l by (cosine_lobe for irradiance, legendre_coefficients of a kernel); as many degrees as
  /// there are factors, at most max_lookup_degree + 1.
  LobeCube(int size, std::span<const double> factors);

  /// From a texture of coefficients as ShProjector's, of the same degree; binds units from 10 on.
  void draw(const GlTexture& coefficients, const Fullscreen& fullscreen) const;

  const GlTexture& cube() const { return cube_; }
  int size() const { return size_; }

 private:
  int size_, tiles_;
  GlTexture cube_, table_;
  GlFramebuffer framebuffer_;
  Program program_;
};

}  // namespace welkin
