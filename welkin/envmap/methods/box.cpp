#include <welkin/envmap/methods/box.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/working_cube.h>
#include <welkin/error.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

constexpr int largest_size = 8192;

Cube halved(const Cube& fine) {
  Cube coarse(std::max(1, fine.size / 2));
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < coarse.size; ++y)
      for (int x = 0; x < coarse.size; ++x)
        for (int c = 0; c < 3; ++c)
          coarse.at(face, x, y)[c] =
              0.25f * (fine.at(face, 2 * x, 2 * y)[c] + fine.at(face, 2 * x + 1, 2 * y)[c] +
                       fine.at(face, 2 * x, 2 * y + 1)[c] + fine.at(face, 2 * x + 1, 2 * y + 1)[c]);
  return coarse;
}

// Bilinear, clamped to the face.
void add_look_up(const Cube& cube, CubePoint point, double weight, double* rgb) {
  const int last = cube.size - 1;
  const double x = std::clamp((point.s + 1) * 0.5 * cube.size - 0.5, 0.0, static_cast<double>(last));
  const double y = std::clamp((point.t + 1) * 0.5 * cube.size - 0.5, 0.0, static_cast<double>(last));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, last), y1 = std::min(y0 + 1, last);
  const double fx = x - x0, fy = y - y0;
  for (int c = 0; c < 3; ++c) {
    const double above = (1 - fx) * static_cast<double>(cube.at(point.face, x0, y0)[c]) +
                         fx * static_cast<double>(cube.at(point.face, x1, y0)[c]);
    const double below = (1 - fx) * static_cast<double>(cube.at(point.face, x0, y1)[c]) +
                         fx * static_cast<double>(cube.at(point.face, x1, y1)[c]);
    rgb[c] += weight * ((1 - fy) * above + fy * below);
  }
}

}  // namespace

// A trilinear look-up in level k is a tent over box-filtered texels: along each axis its variance is (1/12 + 1/6) of a
// texel squared, a deviation of half a texel, and a texel of the cube's level k is 2^k * 2/cube_size wide in the
// middle of a face and sqrt(pi/6) of that in the mean over solid angle. It has the deviation of the kernel where
//   2^k sqrt(pi/6) / cube_size = spread,   k = log2(cube_size spread) + 0.467.
// What is best on maps lies higher, by what the fit of bench_box_bias says (see docs/approximate-filters.md).
double box_level_bias(const ZonalKernel& kernel, int cube_size) {
  constexpr double by_variance = 0.467, fitted = 0.183;
  return std::max(0.0, std::log2(cube_size * kernel_spread(kernel)) + by_variance + fitted);
}

CubeMips box_chain(Cube cube) {
  CubeMips chain;
  chain.levels.push_back(std::move(cube));
  while (chain.levels.back().size > 1) chain.levels.push_back(halved(chain.levels.back()));
  return chain;
}

Cube look_up_box_chain(const CubeMips& chain, const FilterTarget& target, double level) {
  const double last = static_cast<double>(chain.levels.size()) - 1, clamped = std::clamp(level, 0.0, last);
  const auto lower = static_cast<std::size_t>(clamped);
  const auto upper = std::min(lower + 1, chain.levels.size() - 1);
  const double blend = clamped - static_cast<double>(lower);
  return cube_from_directions(target, [&](Vec3 direction, double* rgb) {
    const CubePoint point = cube_point(direction);
    add_look_up(chain.levels[lower], point, 1 - blend, rgb);
    add_look_up(chain.levels[upper], point, blend, rgb);
  });
}

Cube filter_box(const Image& radiance, const FilterTarget& target, const BoxOptions& options) {
  if (options.cube_size < 0 || options.cube_size > largest_size)
    throw Error("the cube of the mip chain must have 1 to 8192 texels along an edge");
  const int size = options.cube_size > 0 ? options.cube_size : matching_cube_size(radiance);
  const double bias = options.bias ? *options.bias : box_level_bias(target.kernel, size);
  if (!(bias >= 0 && bias < 64)) throw Error("the level bias must lie in [0, 64)");
  return look_up_box_chain(box_chain(working_cube(radiance, size)), target, bias);
}

}  // namespace welkin
