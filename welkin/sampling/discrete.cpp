#include <welkin/sampling/discrete.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>

namespace welkin {

// c_i = round((n - k) S_i / S) + (how many of the weights before i are above 0), n = 2^24, k of all: ascending, exactly
// flat where a weight is 0, and the steps add up to n.
void quantised_cdf(const double* weights, std::size_t count, float* cdf) {
  double total = 0, positive = 0;
  for (std::size_t i = 0; i < count; ++i) {
    total += weights[i];
    positive += weights[i] > 0;
  }
  cdf[0] = 0;
  const double scale = total > 0 ? (0x1p24 - positive) / total : 0;
  double sum = 0, before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += weights[i];
    before += weights[i] > 0;
    cdf[i + 1] =
        static_cast<float>((std::min(std::floor(sum * scale + 0.5), 0x1p24 - positive) + before) * 0x1p-24);
  }
}

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights) : cdf_(weights.size() + 1) {
  if (weights.size() > (std::size_t{1} << 23)) throw Error("a distribution over more than 2^23 choices");
  double total = 0;
  for (double weight : weights) {
    if (!(weight >= 0)) throw Error("a distribution with a weight that is negative or not a number");
    total += weight;
  }
  if (!std::isfinite(total)) throw Error("a distribution whose weights have no finite sum");
  quantised_cdf(weights.data(), weights.size(), cdf_.data());
}

}  // namespace welkin
