#pragma once
#include <welkin/pathtrace/integrator.h>

namespace welkin {

/// The weight of a sample that its strategy takes with density `own` (> 0) where another would with `other`, one sample of
/// each: own^b / (own^b + other^b), b = 1 (balance) or 2 (power) (Veach & Guibas 1995, section 3.2). The weights of one
/// direction add up to 1, so the sum of both estimators is unbiased. By the ratio, which cannot overflow to NaN.
inline float mis_weight(MisHeuristic heuristic, float own, float other) {
  const float ratio = other / own;
  return 1 / (1 + (heuristic == MisHeuristic::power ? ratio * ratio : ratio));
}

}  // namespace welkin
