#pragma once
#include <cstddef>
#include <cstdint>
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

/// Where to look in ascending entries from 0 to 1 for numbers in [0, 1) (cutpoints: Chen & Asau 1974): for each of
/// `intervals` equal intervals, a power of two, what last_not_above gives for its lower end, and count - 1 twice at last.
/// Writes intervals + 2 indices. Needs count <= 65,536.
inline void make_cutpoints(const float* entries, std::size_t count, int intervals, std::uint16_t* cutpoints) {
  std::size_t index = 0;
  for (int k = 0; k < intervals; ++k) {
    const float lower = static_cast<float>(k) / static_cast<float>(intervals);
    while (index + 1 < count && entries[index + 1] <= lower) ++index;
    cutpoints[k] = static_cast<std::uint16_t>(index);
  }
  cutpoints[intervals] = cutpoints[intervals + 1] = static_cast<std::uint16_t>(count - 1);
}

/// last_not_above for value in [0, 1], with the two cutpoints of the value's interval: the index lies between theirs.
inline std::size_t last_not_above(const float* entries, const std::uint16_t* cutpoints, float value) {
  const std::size_t first = cutpoints[0];
  return first + last_not_above(entries + first, cutpoints[1] - first + 1, value);
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
