#pragma once
#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>
#include <welkin/sh/projection.h>
#include <welkin/sphere/mapping.h>

namespace welkin {

/// How spherical-harmonic coefficients are summed up in OpenGL. All use tables of Y_lm integrated over each texel's patch and agree to rounding.
enum class ShProjectionMethod {
  tiled,    ///< one pass of (l + 1)^2 pixels, each a sum over all texels (King 2005, listing 10-2)
  staged,   ///< rows first, four coefficients at a time, then sums of rows
  compute,  ///< the same two stages as compute programs (ES 3.1; has_compute())
};

/// Projects maps of one shape in OpenGL, degrees 0 to 8 (max_lookup_degree).
class ShProjector {
 public:
  /// `shape`: a cube or dual paraboloids. Throws Error for another, for a degree out of range, for compute without ES 3.1, and where
  /// the table is larger than textures can be.
  ShProjector(MapShape shape, int degree, ShProjectionMethod method);

  /// Of a cube map (GL_TEXTURE_CUBE_MAP) or a 2-D texture in the layout of the shape; binds units from 10 on.
  void project(const GlTexture& radiance, const Fullscreen& fullscreen) const;

  /// (degree + 1)^2 x 1 texels, RGBA32F, alpha 1; index l(l+1)+m.
  const GlTexture& coefficients() const { return coefficients_.colors[0]; }
  ShCoefficients read() const;
  int degree() const { return degree_; }

 private:
  void make_tables();
  void set_map(const Program& program, const GlTexture& radiance) const;
  void project_compute(const GlTexture& radiance) const;

  MapShape shape_;
  int size_, degree_, count_, groups_;
  ShProjectionMethod method_;
  GlTexture table_;
  GlBuffer table_buffer_, rows_buffer_;
  RenderTarget rows_, coefficients_;
  Program first_, second_;
};

}  // namespace welkin
