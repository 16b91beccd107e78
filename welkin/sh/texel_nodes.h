#pragma once
#include <span>
#include <vector>

#include <welkin/sampling/quadrature.h>
#include <welkin/sphere/mapping.h>

namespace welkin {

/// How a texel's part of an integral over the sphere is taken; its value is the radiance of its whole patch.
enum class TexelRule {
  centre,  ///< the function at the texel's centre times the texel's exact solid angle (King 2005, equation 10-3)
  integrated  ///< the function integrated over the texel's patch
};

/// A node of a quadrature rule on a texel. (a, b) are the coordinates of its face: (s, t) of cube.h, or (a, b) of the
/// paraboloid's disc (mapping.h). The weight includes the mapping's density: weights of a texel add up to its solid
/// angle (sr), so the integral of f over the texel is the sum of weight * f.
struct TexelNode {
  double a = 0, b = 0, weight = 0;
};

/// The rules of all texels of a cube or of a dual paraboloid pair. `integrated` is tensor Gauss-Legendre with the
/// mapping's density, exact for spherical harmonics up to max_degree to about 1e-12 of the texel's solid angle;
/// texels on the rim of a paraboloid are cut along the unit circle.
class TexelNodes {
 public:
  /// Throws Error for other mappings.
  TexelNodes(MapShape shape, int max_degree, TexelRule rule);

  /// The nodes of texel (x, y) of the whole map; valid until the next call. Empty outside the discs.
  std::span<const TexelNode> of(int x, int y);

  /// The unit direction of a node of texel (x, y).
  Vec3 direction(int x, int y, const TexelNode& node) const;

 private:
  struct Box {
    double a0, a1, b0, b1;
  };
  Box box(int x, int y) const;
  double density(double a, double b) const;
  void add_box(const Box& box);
  void add_clipped(const Box& box);
  void add_rim(const Box& box);

  MapShape shape_;
  int size_ = 0;
  TexelRule rule_;
  QuadratureRule gauss_;
  std::vector<TexelNode> nodes_;
};

}  // namespace welkin
