#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <welkin/image/tonemap.h>
#include <welkin/pathtrace/picture.h>

#include "render_job.h"

namespace welkin {

/// What a strategy of light sampling came to on one material.
struct StrategyError {
  double relative_rmse = 0;  ///< of luminance, over the mean luminance of the material's pixels
};

struct StrategyRun {
  std::string name;  ///< as --sampling has it
  std::uint32_t samples = 0;
  double seconds = 0;                 ///< of processor time, all threads
  std::vector<StrategyError> errors;  ///< one for each material of the comparison
  Image radiance;
};

/// The lecture's demonstration: direct light, looked for by each strategy, against a converged picture.
struct StrategyComparison {
  std::vector<std::string> materials;  ///< of the surfaces that the camera sees, in the scene's order
  std::vector<StrategyRun> equal_samples, equal_time;
  PictureLayers converged;
  std::uint32_t converged_samples = 0;
};

/// Called with what is being done and its share; false stops.
using StrategyObserver = std::function<bool(const std::string& what, double share)>;

/// Throws Error where the camera sees no surface. Nothing: stopped.
std::optional<StrategyComparison> compare_strategies(const RenderJob& job, const StrategyObserver& observer);

std::string strategy_json(const StrategyComparison& comparison);
void print_strategies(const StrategyComparison& comparison);
/// Equal samples: one strip for each strategy, then the converged one, at one exposure.
ByteImage strategy_sheet(const StrategyComparison& comparison, const ToneMapOptions& tone);

}  // namespace welkin
