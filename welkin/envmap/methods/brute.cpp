#include <welkin/envmap/methods/brute.h>

#include <algorithm>
#include <vector>

#include <welkin/envmap/brute_force.h>
#include <welkin/sphere/cube.h>

namespace welkin {

Cube filter_brute(const Image& radiance, const FilterTarget& target, const BruteOptions& options) {
  Cube cube(target.size);
  std::vector<Vec3> directions(static_cast<std::size_t>(target.size));
  const int rows = 6 * target.size;
  for (int row = 0; row < rows; ++row) {
    const int face = row / target.size, y = row % target.size;
    for (int x = 0; x < target.size; ++x)
      directions[static_cast<std::size_t>(x)] = cube_texel_direction(target.size, face, x, y);
    const std::vector<double> values = filter_brute_force(radiance, directions, std::span(&target.kernel, 1));
    std::transform(values.begin(), values.end(), cube.at(face, 0, y),
                   [&](double value) { return static_cast<float>(target.scale * value); });
    if (options.progress) options.progress((row + 1.0) / rows);
  }
  return cube;
}

}  // namespace welkin
