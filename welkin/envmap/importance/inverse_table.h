#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <welkin/envmap/importance/texel_weights.h>
#include <welkin/geometry/vec3f.h>
#include <welkin/parallel/prefetch.h>
#include <welkin/sampling/discrete.h>

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
  /// choose of each, of some dozen numbers at most: their waits for memory overlap.
  void choose(std::span<const Vec2f> u, TexelChoice* choices) const;
  /// Asks for what probability(x, y) reads.
  void prefetch_probability(int x, int y) const { prefetch(columns(y) + x); }
  float probability(int x, int y) const {
    const float* cdf = columns(y);
    return (rows_[y + 1] - rows_[y]) * (cdf[x + 1] - cdf[x]);
  }
  /// The numbers for which choose gives this texel and `within`.
  Vec2f invert(int x, int y, Vec2f within) const;
  std::size_t bytes() const {
    return (rows_.size() + columns_.size()) * sizeof(float) +
           (row_cutpoints_.size() + column_cutpoints_.size()) * sizeof(std::uint16_t);
  }
  const std::vector<float>& row_cdf() const { return rows_; }         ///< height + 1 numbers
  const std::vector<float>& column_cdfs() const { return columns_; }  ///< height times width + 1

 private:
  InverseTable(int width, int height);
  const float* columns(int y) const { return columns_.data() + static_cast<std::size_t>(y) * stride_; }

  std::size_t row_of(float u) const {
    const std::uint16_t* cutpoints = row_cutpoints_.data() + static_cast<int>(u * row_scale_);
    return last_not_above(rows_.data(), cutpoints, u);
  }
  const std::uint16_t* column_cutpoints(int y, float u) const {
    return column_cutpoints_.data() + static_cast<std::size_t>(y) * cutpoint_stride_ +
           static_cast<int>(u * column_scale_);
  }
  TexelChoice chosen(std::size_t x, std::size_t y, Vec2f u) const;
  void make_row_cutpoints();
  void make_column_cutpoints(std::size_t y);

  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0, cutpoint_stride_ = 0;
  float row_scale_ = 1, column_scale_ = 1;  // intervals of the cutpoints
  std::vector<float> rows_, columns_;
  std::vector<std::uint16_t> row_cutpoints_, column_cutpoints_;
};

}  // namespace welkin
