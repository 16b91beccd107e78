#pragma once
#include <cstdint>

#include <welkin/envmap/filter.h>

namespace welkin {

struct ImportanceOptions {
  int samples = 64;  ///< a texel, 1 to 1048576
  /// Added to the level that the pdf asks for; 1 as Krivanek & Colbert recommend: samples overlap, so that none of the map is missed.
  double level_bias = 1;
  /// Turns and shifts the points differently at every texel: noise instead of the same pattern, its ghosts, everywhere.
  bool scramble = false;
  std::uint32_t seed = 1;  ///< of the scrambling
  int source_size = 0;     ///< of the cube that is sampled, 1 to 4096; 0: as fine as the map
};

/// Filtered importance sampling (Krivanek & Colbert 2008; Colbert & Krivanek 2007): directions drawn from the kernel itself
/// (inverse of its distribution by numbers, Hammersley points), so the estimate is the plain mean of look-ups; each in
/// the mip level whose texels have the sample's share of solid angle,
///   level = 1/2 log2(omega_s / omega_t) + bias, omega_s = 1 / (samples pdf), omega_t = 4 pi / (6 size^2),
/// trilinear on a cube that is filtered across its edges; mip levels by exact areas.
/// Artefact: too few samples show lamps as many blurred copies, or as noise when scrambled; box-shaped mips. Stated
/// error: see docs/filters.md. Throws Error for options out of range.
Cube filter_importance(const Image& radiance, const FilterTarget& target,
                       const ImportanceOptions& options = {});

}  // namespace welkin
