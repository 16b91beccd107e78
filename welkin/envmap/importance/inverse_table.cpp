#include <welkin/envmap/importance/inverse_table.h>

#include <bit>
#include <numeric>

#include <welkin/parallel/parallel_for.h>

namespace welkin {

InverseTable::InverseTable(int width, int height)
    : width_(width),
      height_(height),
      stride_(static_cast<std::size_t>(width) + 1),
      rows_(static_cast<std::size_t>(height) + 1),
      columns_(stride_ * height) {
  const unsigned row_intervals = std::bit_ceil(static_cast<unsigned>(height));
  const unsigned column_intervals = std::bit_ceil((static_cast<unsigned>(width) + 7) / 8);
  row_scale_ = static_cast<float>(row_intervals);
  column_scale_ = static_cast<float>(column_intervals);
  cutpoint_stride_ = column_intervals + 2;
  row_cutpoints_.resize(row_intervals + 2);
  column_cutpoints_.resize(cutpoint_stride_ * height);
}

void InverseTable::make_row_cutpoints() {
  make_cutpoints(rows_.data(), height_, static_cast<int>(row_scale_), row_cutpoints_.data());
}

void InverseTable::make_column_cutpoints(std::size_t y) {
  make_cutpoints(columns_.data() + y * stride_, width_, static_cast<int>(column_scale_),
                 column_cutpoints_.data() + y * cutpoint_stride_);
}

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
      make_column_cutpoints(y);
    }
  });
  quantised_cdf(row_sums.data(), row_sums.size(), rows_.data());
  make_row_cutpoints();
}

InverseTable::InverseTable(int width, int height, const std::vector<double>& weights)
    : InverseTable(width, height) {
  std::vector<double> row_sums(height_);
  for (int y = 0; y < height; ++y) {
    const double* row = weights.data() + static_cast<std::size_t>(y) * width;
    row_sums[y] = std::accumulate(row, row + width, 0.0);
    quantised_cdf(row, static_cast<std::size_t>(width), columns_.data() + y * stride_);
    make_column_cutpoints(y);
  }
  quantised_cdf(row_sums.data(), row_sums.size(), rows_.data());
  make_row_cutpoints();
}

TexelChoice InverseTable::chosen(std::size_t x, std::size_t y, Vec2f u) const {
  const float* cdf = columns(static_cast<int>(y));
  const float row_share = rows_[y + 1] - rows_[y], share = cdf[x + 1] - cdf[x];
  return {static_cast<int>(x),
          static_cast<int>(y),
          {(u.x - cdf[x]) / share, (u.y - rows_[y]) / row_share},
          row_share * share};
}

TexelChoice InverseTable::choose(Vec2f u) const {
  const std::size_t y = row_of(u.y);
  const int row = static_cast<int>(y);
  return chosen(last_not_above(columns(row), column_cutpoints(row, u.x), u.x), y, u);
}

void InverseTable::choose(std::span<const Vec2f> u, TexelChoice* choices) const {
  for (std::size_t i = 0; i < u.size(); ++i) {
    choices[i].y = static_cast<int>(row_of(u[i].y));
    prefetch(column_cutpoints(choices[i].y, u[i].x));
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    const int y = choices[i].y;
    prefetch(columns(y) + column_cutpoints(y, u[i].x)[0]);
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    const int y = choices[i].y;
    choices[i] = chosen(last_not_above(columns(y), column_cutpoints(y, u[i].x), u[i].x), y, u[i]);
  }
}

Vec2f InverseTable::invert(int x, int y, Vec2f within) const {
  const float* cdf = columns(y);
  return {cdf[x] + within.x * (cdf[x + 1] - cdf[x]), rows_[y] + within.y * (rows_[y + 1] - rows_[y])};
}

}  // namespace welkin
