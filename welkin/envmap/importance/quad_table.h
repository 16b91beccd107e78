#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <welkin/envmap/importance/inverse_table.h>

namespace welkin {

/// A hierarchical warp (Clarberg et al. 2005; McCool & Harwood 1997): tiles of 8 x 8 texels by inverting their CDFs, then
/// three halvings each way down to a texel. The splits of the first two of them are stored, in 16 bits each; those of the
/// last, among 2 x 2 texels, are read off the map itself. Monotone in both numbers: stratified numbers stay so. About 0.53
/// bytes a texel, 13 % of its CDF in floats.
class QuadTable {
 public:
  QuadTable() = default;
  /// Keeps a reference to weights.map.
  explicit QuadTable(const TexelWeights& weights);

  TexelChoice choose(Vec2f u) const;
  /// choose of each, of some dozen numbers at most: their waits for memory overlap.
  void choose(std::span<const Vec2f> u, TexelChoice* choices) const;
  float probability(int x, int y) const;
  Vec2f invert(int x, int y, Vec2f within) const;
  std::size_t bytes() const {
    return tiles_.bytes() + splits_.size() * sizeof(splits_[0]) + row_factor_.size() * sizeof(float);
  }

 private:
  static constexpr int size = 8;  // of a tile
  using Splits =
      std::array<std::uint16_t, 15>;  // 3 of the tile, then 3 of each quarter: rows, columns above, below
  struct Path;
  const Splits& splits(int tile_x, int tile_y) const {
    return splits_[static_cast<std::size_t>(tile_y) * tiles_wide_ + tile_x];
  }
  void to_block(TexelChoice& choice) const;
  void to_texel(TexelChoice& choice) const;
  float weight(int x, int y) const;
  Path path(int x, int y) const;

  const Image* map_ = nullptr;
  int tiles_wide_ = 0;
  std::array<float, 3> channels_{};
  std::vector<float> row_factor_;
  InverseTable tiles_;
  std::vector<Splits> splits_;
};

/// A split in 16 bits: the smaller side's share with 11 significant bits, from 2^-24 to 1/2, and which side that is. Exactly 0
/// or 1 only for a share that is.
std::uint16_t encode_split(double first_share);
float decode_split(std::uint16_t code);

}  // namespace welkin
