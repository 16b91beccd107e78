#pragma once
#include <vector>

#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>

// Glossy maps of a captured cube, cheap enough for every frame: what each approximates is the radiance filtered by the GGX lobe of a perceptual
// roughness (n = v = r). docs/realtime-dynamic.md has their errors and times.

namespace welkin {

enum class GlossyMethod {
  box,  ///< the driver's mip chain, one look-up in the level as wide as the lobe (Ashikhmin & Ghosh 2003, Kautz et al. 2004)
  bordered,  ///< the same of faces that go on over their neighbours (to twice their width), each a picture of its own
  paraboloid,  ///< of two paraboloids that go on beyond their rims: the kernels of middle and rim blended (Kautz et al. 2000)
  quick,  ///< few taps in a chain of B-splines, into a chain by roughness (after Manson & Sloan 2016; envmap/methods/quick.h)
  importance,  ///< the same with filtered importance sampling (Krivanek & Colbert 2008)
};

struct GlossyOptions {
  GlossyMethod method = GlossyMethod::quick;
  /// Shows what is wrong without the remedy: faces looked up alone (box, bordered), paraboloids that end at the rim. The others know no edges.
  bool seams_shown = false;
  int taps = 16;   ///< 2 to 64: quick, importance
  int size = 128;  ///< of the captured cube, a power of two
};

/// A look-up around a direction, for one level of a filtered chain.
struct GlossyTaps {
  std::vector<Vec3f> directions;  ///< unit, z along the direction
  std::vector<Vec3f> sizes;       ///< footprint's deviation (rad) or level; weight; 0
};

class GlossyMaps {
 public:
  explicit GlossyMaps(const GlossyOptions& options);

  /// Makes the maps of a cube with a full chain of mips, of which level 0 holds the radiance; the other levels are written to. Binds units from 10 on.
  void update(const GlTexture& cube, const Fullscreen& fullscreen);

  /// Binds units 11 and 12 and sets all uniforms of glossy.glsl; the program is in use, and `cube` is what update() was given.
  void set(const Program& program, const GlTexture& cube) const;

 private:
  void draw_pictures(const GlTexture& cube, const Fullscreen& fullscreen);
  void draw_splines(const GlTexture& cube, const Fullscreen& fullscreen);
  void draw_filtered(const GlTexture& cube, const Fullscreen& fullscreen);
  bool filtered() const;
  bool pictures() const;

  GlossyOptions options_;
  std::vector<float> spreads_;
  std::vector<GlossyTaps> taps_;  // by level
  int levels_ = 1, picture_size_ = 0, filtered_levels_ = 1;
  float reach_ = 1;
  GlTexture pictures_, filtered_;
  GlFramebuffer framebuffer_;
  Program picture_, spline_, taps_program_;
};

}  // namespace welkin
