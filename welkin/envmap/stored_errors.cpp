#include <welkin/envmap/stored_errors.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/envmap/cube_steps.h>

namespace welkin {
namespace {

StoredErrors compare_level(const Cube& stored, const Cube& computed, EdgeFixup fixup) {
  assert(stored.texels.size() == computed.texels.size());
  double squared_error = 0, squared_truth = 0, largest = 0;
  for (std::size_t i = 0; i < computed.texels.size(); ++i) {
    const double truth = computed.texels[i], error = static_cast<double>(stored.texels[i]) - truth;
    squared_error += error * error;
    squared_truth += truth * truth;
    largest = std::max(largest, std::abs(error));
  }
  const double energy = cube_energy(computed), mean = energy / (4 * std::numbers::pi);
  StoredErrors errors;
  errors.relative_rms = squared_truth > 0 ? std::sqrt(squared_error / squared_truth) : 0;
  errors.max_over_mean = mean > 0 ? largest / mean : 0;
  errors.energy = energy > 0 ? cube_energy(stored) / energy - 1 : 0;
  errors.edge_step = fixup == EdgeFixup::none ? edge_step_ratio(stored) : 0;
  errors.face_step = face_edge_step(stored, fixup);
  return errors;
}

}  // namespace

std::vector<StoredErrors> stored_errors(const CubeMips& stored, const CubeMips& computed, EdgeFixup fixup) {
  assert(stored.levels.size() == computed.levels.size());
  std::vector<StoredErrors> errors;
  for (std::size_t k = 0; k < computed.levels.size(); ++k)
    errors.push_back(compare_level(stored.levels[k], computed.levels[k], fixup));
  return errors;
}

}  // namespace welkin
