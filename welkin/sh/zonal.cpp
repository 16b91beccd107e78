#include <welkin/sh/zonal.h>

#include <cassert>
#include <cstring>

#include <welkin/parallel/target_clones.h>

namespace welkin {
namespace {

constexpr int lane_count = 16;
using Lanes = double __attribute__((vector_size(lane_count * sizeof(double))));

// Adds sum over lanes of w P_l(x) to sums[l].
WELKIN_TARGET_CLONES void add_block(const double* cosines, const double* weights, int max_degree,
                                    double* sums) {
  Lanes x, weight, previous = {}, current;
  std::memcpy(&x, cosines, sizeof x);
  std::memcpy(&weight, weights, sizeof weight);
  current = weight;  // the weight rides along: the recurrence is linear
  for (int l = 0; l <= max_degree; ++l) {
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += current[lane];
    sums[l] += sum;
    const double a = (2.0 * l + 1) / (l + 1), b = static_cast<double>(l) / (l + 1);
    const Lanes next = a * x * current - b * previous;
    previous = current;
    current = next;
  }
}

}  // namespace

std::vector<double> project_zonal(std::span<const double> cosines, std::span<const double> weights,
                                  int max_degree) {
  assert(cosines.size() == weights.size());
  std::vector<double> sums(max_degree + 1);
  for (std::size_t first = 0; first < cosines.size(); first += lane_count) {
    double x[lane_count] = {}, w[lane_count] = {};
    for (std::size_t i = first; i < cosines.size() && i < first + lane_count; ++i) {
      x[i - first] = cosines[i];
      w[i - first] = weights[i];
    }
    add_block(x, w, max_degree, sums.data());
  }
  return sums;
}

}  // namespace welkin
