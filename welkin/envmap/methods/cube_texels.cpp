#include <welkin/envmap/methods/cube_texels.h>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {

Cube cube_from_directions(const FilterTarget& target,
                          const std::function<void(Vec3 direction, double* rgb)>& value) {
  Cube cube(target.size);
  const int n = target.size;
  const auto fill_row = [&](int row) {
    for (int x = 0; x < n; ++x) {
      double rgb[3] = {};
      value(cube_texel_direction(n, row / n, x, row % n), rgb);
      for (int c = 0; c < 3; ++c) cube.at(row / n, x, row % n)[c] = static_cast<float>(target.scale * rgb[c]);
    }
  };
  parallel_for(static_cast<std::size_t>(6) * n, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) fill_row(static_cast<int>(row));
  });
  return cube;
}

int matching_cube_size(const Image& equirect) {
  int size = 8;
  while (size < 4096 && 4 * size < equirect.width) size *= 2;
  return size;
}

}  // namespace welkin
