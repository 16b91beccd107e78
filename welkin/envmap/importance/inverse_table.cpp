#include <welkin/envmap/importance/inverse_table.h>

#include <numeric>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/discrete.h>

namespace welkin {

InverseTable::InverseTable(int width, int height)
    : width_(width),
      height_(height),
      stride_(static_cast<std::size_t>(width) + 1),
      rows_(static_cast<std::size_t>(height) + 1),
      columns_(stride_ * height) {}

InverseTable::InverseTable(const TexelWeights& weights)
    : InverseTable(weights.map.width, weights.map.height) {
  std::vector<double> row_sums(height_);
  parallel_for(height_, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<double> row(width_);
    for (std::size_t y = begin; y < end; ++y) {
      for (int x = 0; x < width_; ++x) {
        row[x] = weights(x, static_cast<int>(y));
        row_sums[y] += row[x];
      }
      quantised_cdf(row.data(), row.size(), columns_.data() + y * stride_);
    }
  });
  quantised_cdf(row_sums.data(), row_sums.size(), rows_.data());
}

InverseTable::InverseTable(int width, int height, const std::vector<double>& weights)
    : InverseTable(width, height) {
  std::vector<double> row_sums(height_);
  for (int y = 0; y < height; ++y) {
    const double* row = weights.data() + static_cast<std::size_t>(y) * width;
    row_sums[y] = std::accumulate(row, row + width, 0.0);
    quantised_cdf(row, static_cast<std::size_t>(width), columns_.data() + y * stride_);
  }
  quantised_cdf(row_sums.data(), row_sums.size(), rows_.data());
}

TexelChoice InverseTable::choose(Vec2f u) const {
  const std::size_t y = last_not_above(rows_.data(), height_, u.y);
  const float* cdf = columns(static_cast<int>(y));
  const std::size_t x = last_not_above(cdf, width_, u.x);
  const float row_share = rows_[y + 1] - rows_[y], share = cdf[x + 1] - cdf[x];
  return {static_cast<int>(x),
          static_cast<int>(y),
          {(u.x - cdf[x]) / share, (u.y - rows_[y]) / row_share},
          row_share * share};
}

Vec2f InverseTable::invert(int x, int y, Vec2f within) const {
  const float* cdf = columns(y);
  return {cdf[x] + within.x * (cdf[x + 1] - cdf[x]), rows_[y] + within.y * (rows_[y + 1] - rows_[y])};
}

}  // namespace welkin
