#include <welkin/envmap/importance/inverse_table.h>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/discrete.h>

namespace welkin {

InverseTable::InverseTable(const TexelWeights& weights)
    : width_(weights.map.width),
      height_(weights.map.height),
      stride_(static_cast<std::size_t>(weights.map.width) + 1),
      rows_(static_cast<std::size_t>(weights.map.height) + 1),
      columns_(stride_ * weights.map.height) {
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
