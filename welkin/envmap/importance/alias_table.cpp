#include <welkin/envmap/importance/alias_table.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr float largest = 0x1.fffffep-1f;

// A place keeps at least so much of itself where its texel is lit: what the numbers of a place can tell apart.
constexpr double least_keep = 0x1p-20;

std::vector<double> all_weights(const TexelWeights& weights) {
  std::vector<double> all;
  all.reserve(weights.map.pixels.size() / 3);
  for (int y = 0; y < weights.map.height; ++y)
    for (int x = 0; x < weights.map.width; ++x) all.push_back(weights(x, y));
  return all;
}

}  // namespace

// Vose: places with less than the mean are filled up by texels with more. `share` is a texel's weight in means that is yet
// to be given away. Thresholds are multiples of 2^-24, which is what the remainder of the numbers can be.
AliasTable::AliasTable(const TexelWeights& weights) : width_(weights.map.width), height_(weights.map.height) {
  const std::size_t count = static_cast<std::size_t>(width_) * height_;
  if (std::uint64_t{count} >= std::uint64_t{1} << 32) throw Error("a map of more than 2^32 texels has no alias table");
  std::vector<double> share = all_weights(weights);
  double total = 0;
  for (double w : share) total += w;
  entries_.resize(count);
  probabilities_.resize(count);
  if (!(total > 0)) return;
  for (double& w : share) w *= static_cast<double>(count) / total;
  const auto brightest =
      static_cast<std::uint32_t>(std::max_element(share.begin(), share.end()) - share.begin());
  // One array holds both lists: those with little from the front, those with much from the back.
  std::vector<std::uint32_t> list(count);
  std::size_t little = 0, much = count;
  for (std::size_t i = 0; i < count; ++i)
    (share[i] < 1 ? list[little++] : list[--much]) = static_cast<std::uint32_t>(i);
  std::vector<double> given(count);
  const auto settle = [&](std::uint32_t place, double keep, std::uint32_t other) {
    const double rounded = std::floor(keep * 0x1p24 + 0.5) * 0x1p-24;
    entries_[place] = {static_cast<float>(rounded), other};
    given[place] += rounded;
    given[other] += 1 - rounded;
  };
  while (little > 0 && much < count) {
    const std::uint32_t low = list[--little], high = list[much];
    const double keep = share[low] > 0 ? std::max(share[low], least_keep) : 0;
    settle(low, keep, high);
    share[high] -= 1 - keep;
    if (share[high] < 1) {
      ++much;
      list[little++] = high;
    }
  }
  // What is left over has a share of one but for rounding.
  while (much < count) settle(list[much], 1, list[much]), ++much;
  while (little > 0) {
    const std::uint32_t place = list[--little];
    settle(place,
           share[place] > 0.5 ? 1
           : share[place] > 0 ? std::max(share[place], least_keep)
                              : 0,
           brightest);
  }
  for (std::size_t i = 0; i < count; ++i)
    probabilities_[i] = static_cast<float>(given[i] / static_cast<double>(count));
}

// 24 bits of each number, as integers: the product with the size is the column and, below, the remainder, exactly. The
// remainder of x has but 24 - log2(width) bits; those of y lengthen it.
TexelChoice AliasTable::choose(Vec2f u) const {
  const auto place = [](float number, int size, float& remainder) {
    const auto product = static_cast<std::uint64_t>(number * 0x1p24f) * static_cast<std::uint64_t>(size);
    remainder = static_cast<float>(product & 0xffffffu) * 0x1p-24f;
    return static_cast<std::uint32_t>(product >> 24);
  };
  Vec2f rest;
  const std::uint32_t x = place(u.x, width_, rest.x), y = place(u.y, height_, rest.y);
  const std::uint32_t at = y * static_cast<std::uint32_t>(width_) + x;
  const Entry& entry = entries_[at];
  const float t = std::min(rest.x + static_cast<float>(width_) * 0x1p-24f * rest.y, largest);
  const bool keep = t < entry.keep;
  const std::uint32_t texel = keep ? at : entry.other;
  const float within = keep ? t / entry.keep : (t - entry.keep) / (1 - entry.keep);
  return {static_cast<int>(texel % static_cast<std::uint32_t>(width_)),
          static_cast<int>(texel / static_cast<std::uint32_t>(width_)),
          {std::min(within, largest), rest.y},
          probabilities_[texel]};
}

}  // namespace welkin
