#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include <welkin/envmap/reflection/truth.h>

// Errors of view-dependent reflections over views, for the benchmarks.

namespace bench {

struct ReflectionError {
  double relative_rms = 0;  // over all queries and channels
  double mean = 0;          // of |error| over the mean truth
  double largest = 0;       // of |error| over the mean truth
  double by_angle[3] = {};  // relative RMS where cos_view is above 2/3, above 1/3, and below
};

using Reflect = std::function<std::array<double, 3>(const welkin::ReflectionQuery&)>;

inline ReflectionError reflection_error(const std::vector<welkin::ReflectionQuery>& queries,
                                        const std::vector<double>& truth, const Reflect& reflect) {
  double error2 = 0, truth2 = 0, error1 = 0, truth1 = 0, largest = 0;
  double part_error[3] = {}, part_truth[3] = {};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto value = reflect(queries[i]);
    const double cos_view = dot(queries[i].normal, queries[i].view);
    const int part = cos_view > 2.0 / 3 ? 0 : cos_view > 1.0 / 3 ? 1 : 2;
    for (int c = 0; c < 3; ++c) {
      const double t = truth[3 * i + c], e = std::abs(value[c] - t);
      error2 += e * e, truth2 += t * t, error1 += e, truth1 += t;
      part_error[part] += e * e, part_truth[part] += t * t;
      largest = std::max(largest, e);
    }
  }
  ReflectionError error;
  const double mean = truth1 / static_cast<double>(truth.size());
  error.relative_rms = std::sqrt(error2 / truth2);
  error.mean = error1 / truth1;
  error.largest = largest / mean;
  for (int p = 0; p < 3; ++p) error.by_angle[p] = std::sqrt(part_error[p] / part_truth[p]);
  return error;
}

}  // namespace bench
