#pragma once
#include <welkin/envmap/filter.h>

namespace welkin {

struct ParaboloidOptions {
  /// How far each picture goes on beyond the rim of its hemisphere, in radii, 0 to 3; < 0: as far as the larger
  /// kernel reaches, at most 2.
  double border = -1;
};

/// Two paraboloid pictures, one a hemisphere (Heidrich & Seidel 1998), with borders that show what lies beyond the
/// rim, each filtered as a flat picture twice: by the lobe as it appears in the middle of the picture, its smallest,
/// and by the lobe at the rim, twice as large; at radius r between, where the lobe is (1 + r^2) times the smallest,
/// the two are blended (Kautz et al. 2000, "A unified approach to prefiltered environment maps"). Artefacts: a blend
/// of a narrow and a wide lobe is not a lobe of the width between: peaks are too sharp and skirts too wide halfway to
/// the rim; lobes at the rim ignore that the picture grows outwards, so the two hemispheres disagree where they meet
/// (z = 0): a seam under strong lamps. Measured relative RMS: 2 to 9 % on photographs of a sunset and of a night
/// street, 8 to 39 % where a few lamps or a hard sun are nearly all; see docs/approximate-filters.md. Throws Error
/// for a border outside its range.
Cube filter_paraboloid(const Image& radiance, const FilterTarget& target,
                       const ParaboloidOptions& options = {});

}  // namespace welkin
