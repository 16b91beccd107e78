#pragma once
#include <optional>

#include <welkin/envmap/filter.h>

namespace welkin {

struct BoxOptions {
  /// Texels along an edge of the cube whose mip chain is used; 0: the least power of two that holds the map's texels.
  int cube_size = 0;
  /// The level that is looked up, counted from that cube; none: box_level_bias of the kernel. 0 or more.
  std::optional<double> bias;
};

/// The mip level (of a cube with `cube_size` texels along an edge, level 0) whose trilinear look-up is nearest to a
/// kernel: log2(cube_size * kernel_spread) + 0.65, not below 0. Derivation and fit: docs/approximate-filters.md.
double box_level_bias(const ZonalKernel& kernel, int cube_size);

/// The chain that hardware makes: each texel the plain mean of four, each face by itself.
CubeMips box_chain(Cube cube);

/// A level of the chain, trilinear, for every texel of the target, each face by itself (no texels of neighbours).
Cube look_up_box_chain(const CubeMips& chain, const FilterTarget& target, double level);

/// The mip chain that hardware makes of a cube, each face halved by itself with the plain mean of four texels, and a
/// trilinear look-up with a level bias, each face filtered by itself too: no texels of neighbours, as before seamless
/// filtering (the box filtered maps of Ashikhmin & Ghosh 2003 and Kautz et al. 2004).
/// Artefacts: square footprints with steps between texels, no tails; a width that follows the texels (5.2 times less
/// solid angle in a corner than in the middle of a face); faces know nothing of each other: at coarse levels each
/// edge is a step. Measured relative RMS: 9 to 34 % on photographs of a sunset and of a night street, 19 to 130 %
/// where a few lamps or a hard sun are nearly all; see docs/approximate-filters.md. Throws Error for sizes outside 1
/// to 8192 and a bias that is negative or not finite.
Cube filter_box(const Image& radiance, const FilterTarget& target, const BoxOptions& options = {});

}  // namespace welkin
