// The area of a polygon inside a cell is the signed sum, over its edges, of the area inside the cell to the right of
// the edge. An edge that passes a row of cells with height dy contributes dy to every cell to its right, and
// dy (1 - m) to the cell it is in, where m is its mean distance from the cell's left side. So each edge only
// touches the cells it passes (as the difference to the cell before), and one running sum along each row gives all
// areas: the cost is that of the perimeter, not of clipping every cell.
#include <welkin/sphere/cell_coverage.h>

#include <algorithm>
#include <cmath>

namespace welkin {

bool CellCoverage::measure(std::span<const GridPoint> polygon, int max_cells) {
  double left = polygon[0].x, right = left, top = polygon[0].y, bottom = top;
  for (GridPoint p : polygon) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  if (!(right - left < max_cells - 1) || !(bottom - top < max_cells - 1)) return false;
  x0_ = static_cast<int>(std::floor(left));
  y0_ = static_cast<int>(std::floor(top));
  width_ = static_cast<int>(std::floor(right)) - x0_ + 1;
  height_ = static_cast<int>(std::floor(bottom)) - y0_ + 1;
  area_.assign(static_cast<std::size_t>(width_ + 1) * height_, 0);
  double twice_area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    GridPoint from = polygon[i], to = polygon[(i + 1) % polygon.size()];
    from = {from.x - x0_, from.y - y0_};
    to = {to.x - x0_, to.y - y0_};
    add_edge(from, to);
    twice_area += from.x * to.y - from.y * to.x;
  }
  const double orientation = twice_area < 0 ? 1 : -1;
  for (int y = 0; y < height_; ++y) {
    double* cells = area_.data() + static_cast<std::size_t>(y) * (width_ + 1);
    double sum = 0;
    for (int x = 0; x < width_; ++x) {
      sum += cells[x];
      cells[x] = std::clamp(orientation * sum, 0.0, 1.0);
    }
  }
  return true;
}

void CellCoverage::add_edge(GridPoint from, GridPoint to) {
  if (from.y == to.y) return;
  const bool down = from.y < to.y;
  const GridPoint a = down ? from : to, b = down ? to : from;
  const double slope = (b.x - a.x) / (b.y - a.y);
  const double lowest = std::min(a.x, b.x), highest = std::max(a.x, b.x);
  double y = a.y, x = a.x;
  for (int row = static_cast<int>(a.y); row < height_ && y < b.y; ++row) {
    const double next_y = std::min(b.y, row + 1.0);
    const double next_x = next_y == b.y ? b.x : std::clamp(a.x + slope * (next_y - a.y), lowest, highest);
    add_row_piece(row, x, next_x, down ? next_y - y : y - next_y);
    y = next_y;
    x = next_x;
  }
}

// A piece of an edge inside one row, from xa to xb, with signed height dy.
void CellCoverage::add_row_piece(int row, double xa, double xb, double dy) {
  double* cells = area_.data() + static_cast<std::size_t>(row) * (width_ + 1);
  const double left = std::min(xa, xb), right = std::max(xa, xb);
  const double per_x = right > left ? dy / (right - left) : 0;
  int cell = static_cast<int>(left);
  for (double x = left;; ++cell) {
    const double next = std::min(right, cell + 1.0);
    const double height = next == right && x == left ? dy : per_x * (next - x);
    const double offset = (x + next) / 2 - cell;
    cells[cell] += height * (1 - offset);
    cells[cell + 1] += height * offset;
    if (next >= right) break;
    x = next;
  }
}

}  // namespace welkin
