#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "ibl_files.h"
#include "ibl_stored.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/lights_check.h>
#include <welkin/envmap/verify.h>

namespace welkin {

/// Everything that the manifest speaks of. Pointers are never null but where said.
struct ManifestInput {
  const Environment* environment = nullptr;
  double rotate_degrees = 0;
  bool mirror = false;
  const IblSet* set = nullptr;
  const IblOptions* options = nullptr;
  const std::vector<IblFile>* files = nullptr;
  const std::optional<IblErrors>* errors = nullptr;
  const IblFileOptions* file_options = nullptr;
  const std::optional<StoredSetErrors>* stored = nullptr;
  const ExtractedLights* lights = nullptr;             ///< null: none were asked for
  const RecombinationErrors* recombination = nullptr;  ///< of the lights
  double load_seconds = 0, total_seconds = 0;
};

/// manifest.json: what each file is, units, level law, conventions, errors, timings, input statistics. Documented in
/// docs/ibl.md.
nlohmann::ordered_json make_manifest(const ManifestInput& input);

}  // namespace welkin
