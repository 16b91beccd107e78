#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <welkin/envmap/importance/inverse_table.h>

namespace welkin {

/// Walker's alias method over all texels (Walker 1977; built by Vose 1991): the two numbers pick a texel of the map
/// evenly, what is left of them keeps it or takes the other texel that shares its place. One look-up, whatever the size;
/// neighbouring numbers may land far apart. What is left serves as the place within the texel.
class AliasTable {
 public:
  AliasTable() = default;
  explicit AliasTable(const TexelWeights& weights);

  struct Entry {
    float keep = 1;           ///< the place's own texel is kept where the remainder is below
    std::uint32_t other = 0;  ///< else this one, y * width + x
  };
  TexelChoice choose(Vec2f u) const;
  float probability(int x, int y) const { return probabilities_[static_cast<std::size_t>(y) * width_ + x]; }
  std::size_t bytes() const {
    return entries_.size() * sizeof(Entry) + probabilities_.size() * sizeof(float);
  }
  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<float>& probabilities() const { return probabilities_; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<Entry> entries_;
  std::vector<float> probabilities_;  ///< exactly what `entries_` gives each texel
};

}  // namespace welkin
