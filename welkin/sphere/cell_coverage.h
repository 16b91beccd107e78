#pragma once
#include <span>
#include <vector>

namespace welkin {

/// A point in continuous texel coordinates.
struct GridPoint {
  double x = 0, y = 0;
};

/// Exactly how much of each cell of a grid a small polygon covers. Reused from polygon to polygon, so that nothing
/// is allocated once it has grown.
class CellCoverage {
 public:
  /// Measures a polygon without self-intersections, in either orientation. All its cells must fit in
  /// max_cells x max_cells; false (and nothing measured) where they do not.
  bool measure(std::span<const GridPoint> polygon, int max_cells = 48);

  int x0() const { return x0_; }
  int y0() const { return y0_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Row `row` of the box: width() covered areas in [0, 1], cell (x0() + i, y0() + row) at index i.
  std::span<const double> row(int row_index) const {
    return {area_.data() + static_cast<std::size_t>(row_index) * (width_ + 1),
            static_cast<std::size_t>(width_)};
  }

 private:
  void add_edge(GridPoint from, GridPoint to);
  void add_row_piece(int row, double xa, double xb, double dy);

  int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
  std::vector<double> area_;
};

}  // namespace welkin
