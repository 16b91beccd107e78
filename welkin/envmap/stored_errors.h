#pragma once
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/cube_edge_fixup.h>

namespace welkin {

/// What rounding or compression to a file's format did to one level of a cube. mean is the computed level's mean
/// luminance.
struct StoredErrors {
  double relative_rms = 0;   ///< over all texels: RMS of the difference over RMS of the computed level
  double max_over_mean = 0;  ///< the largest difference of a channel over the mean
  double energy = 0;     ///< integral over the sphere (cube_energy) over that of the computed level, minus 1
  double edge_step = 0;  ///< edge_step_ratio of the stored level; 0 where it is too small, and after a fix-up
  double face_step = 0;  ///< face_edge_step of the stored level: for samplers that do not filter across faces
};

/// One entry a level. Both cubes have 3 channels and the same sizes; `fixup` is what was done to both.
std::vector<StoredErrors> stored_errors(const CubeMips& stored, const CubeMips& computed, EdgeFixup fixup);

}  // namespace welkin
