#pragma once
#include <cstddef>
#include <vector>

#include <welkin/envmap/importance/texel_weights.h>
#include <welkin/geometry/vec3f.h>

namespace welkin {

/// A texel that a table picked.
struct TexelChoice {
  int x = 0, y = 0;
  Vec2f within;           ///< what is left of the two numbers, uniform in [0, 1)^2
  float probability = 0;  ///< of this texel; above 0
};

/// The 2-D inverse transform: a CDF over rows, and one over the columns of each row, as floats that are multiples of
/// 2^-24, the resolution of the numbers that are handed in, so that the share of a texel is exactly the share of such
/// numbers that pick it. Every texel with a weight above 0 has at least one of them in its row, every row at least one.
class InverseTable {
 public:
  InverseTable() = default;
  explicit InverseTable(const TexelWeights& weights);
  /// weights: row by row.
  InverseTable(int width, int height, const std::vector<double>& weights);

  TexelChoice choose(Vec2f u) const;
  float probability(int x, int y) const {
    const float* cdf = columns(y);
    return (rows_[y + 1] - rows_[y]) * (cdf[x + 1] - cdf[x]);
  }
  /// The numbers for which choose gives this texel and `within`.
  Vec2f invert(int x, int y, Vec2f within) const;
  std::size_t bytes() const { return (rows_.size() + columns_.size()) * sizeof(float); }
  const std::vector<float>& row_cdf() const { return rows_; }         ///< height + 1 numbers
  const std::vector<float>& column_cdfs() const { return columns_; }  ///< height times width + 1

 private:
  InverseTable(int width, int height);
  const float* columns(int y) const { return columns_.data() + static_cast<std::size_t>(y) * stride_; }

  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;
  std::vector<float> rows_, columns_;
};

}  // namespace welkin
