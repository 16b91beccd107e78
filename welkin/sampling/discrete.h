#pragma once
#include <cstddef>
#include <span>
#include <vector>

// Picking one of n things with given chances.

namespace welkin {

/// A CDF of `count` weights (>= 0, finite) as count + 1 multiples of 2^-24 from 0 to 1: rounded, but each weight above 0 has
/// a step of at least 2^-24 and each weight 0 none. All 0 when the weights are. Needs count < 2^24.
void quantised_cdf(const double* weights, std::size_t count, float* cdf);

/// The last index below count whose entry is <= value, for ascending entries with entries[0] <= value. No branches that
/// depend on the data.
inline std::size_t last_not_above(const float* entries, std::size_t count, float value) {
  const float* base = entries;
  while (count > 1) {
    const std::size_t half = count / 2;
    base = base[half] <= value ? base + half : base;
    count -= half;
  }
  return static_cast<std::size_t>(base - entries);
}

/// Picks an index with a chance proportional to its weight, by inverting the CDF: ascending numbers pick ascending
/// indices, so stratified numbers pick stratified. Immutable, thread-safe.
class DiscreteDistribution {
 public:
  struct Choice {
    std::size_t index = 0;
    float probability = 0;  ///< above 0; 0: all weights are 0 and nothing was picked
    float remainder = 0;    ///< uniform in [0, 1), independent of index: to be used again
  };

  DiscreteDistribution() : DiscreteDistribution(std::span<const double>()) {}
  /// At most 2^23 weights, finite and >= 0, whose sum is finite. Throws Error otherwise. All 0, or none: picks nothing.
  explicit DiscreteDistribution(std::span<const double> weights);

  std::size_t size() const { return cdf_.size() - 1; }
  bool empty() const { return cdf_.back() == 0; }
  /// u in [0, 1).
  Choice choose(float u) const {
    if (empty()) return {};
    const std::size_t i = last_not_above(cdf_.data(), size(), u);
    const float share = cdf_[i + 1] - cdf_[i], remainder = (u - cdf_[i]) / share;
    return {i, share, remainder < 1 ? remainder : 0x1.fffffep-1f};
  }
  /// Of picking `index` < size(): exactly the share of the multiples of 2^-24 that do.
  float probability(std::size_t index) const { return cdf_[index + 1] - cdf_[index]; }

 private:
  std::vector<float> cdf_;
};

}  // namespace welkin
