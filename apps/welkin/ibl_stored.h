#pragma once
#include <optional>
#include <vector>

#include "ibl_files.h"

#include <welkin/envmap/stored_errors.h>

namespace welkin {

/// What the files hold, against what was computed (after the edge fix-up, where one was asked for).
struct StoredSetErrors {
  std::vector<StoredErrors> specular;  ///< one a level
  StoredErrors irradiance;
};

/// Decodes the specular and irradiance files and compares every texel.
StoredSetErrors measure_stored(const IblSet& set, const std::vector<IblFile>& files,
                               const IblFileOptions& options);

}  // namespace welkin
