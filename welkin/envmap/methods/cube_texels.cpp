#include <welkin/envmap/methods/cube_texels.h>

#include <algorithm>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {

Cube cube_from_directions(const FilterTarget& target,
                          const std::function<void(Vec3 direction, double* rgb)>& value,
                          const std::function<void(double)>& progress) {
  Cube cube(target.size);
  const int n = target.size;
  const auto fill_row = [&](int row) {
    for (int x = 0; x < n; ++x) {
      double rgb[3] = {};
      value(cube_texel_direction(n, row / n, x, row % n), rgb);
      for (int c = 0; c < 3; ++c) cube.at(row / n, x, row % n)[c] = static_cast<float>(target.scale * rgb[c]);
    }
  };
  const auto rows = static_cast<std::size_t>(6 * n), slab = std::max<std::size_t>(16, rows / 64);
  for (std::size_t first = 0; first < rows; first += slab) {
    parallel_for(std::min(slab, rows - first), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = first + begin; row < first + end; ++row) fill_row(static_cast<int>(row));
    });
    if (progress) progress(static_cast<double>(std::min(rows, first + slab)) / static_cast<double>(rows));
  }
  return cube;
}

int matching_cube_size(const Image& equirect) {
  int size = 8;
  while (size < 4096 && 4 * size < equirect.width) size *= 2;
  return size;
}

}  // namespace welkin
