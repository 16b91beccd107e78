#include <welkin/envmap/methods/paraboloid.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/envmap/methods/planar_filter.h>
#include <welkin/envmap/methods/working_cube.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/cube_mips.h>

namespace welkin {
namespace {

// The direction of (a, b), also beyond the rim; side is +1 for z >= 0 and -1 for z < 0. This is the stereographic
// projection: with r^2 = a^2 + b^2, |z| = (1 - r^2)/(1 + r^2), and a unit of the picture is an angle of 2/(1 + r^2).
Vec3 paraboloid_direction(double a, double b, double side) {
  const double scale = 2 / (1 + a * a + b * b);
  return {a * scale, b * scale, side * (scale - 1)};
}

// Texels along the diameter of a disc, of the pictures that are filtered and of the results.
struct Sizes {
  int source = 0, result = 0;
};

// In the middle a texel is an angle of 4/size: an eighth of the lobe's width in the source, unless that is finer than
// the map, and half of it in the results, unless that is finer than the source.
Sizes disc_sizes(const Image& radiance, const ZonalKernel& kernel) {
  const double width = angular_width(kernel);
  Sizes sizes{16, 16};
  while (sizes.source < 4 * matching_cube_size(radiance) && 4.0 / sizes.source > width / 8) sizes.source *= 2;
  while (sizes.result < sizes.source && 4.0 / sizes.result > width / 4) sizes.result *= 2;
  return sizes;
}

// Each texel the mean of four look-ups in the mip level whose texels are as wide.
PlanePicture hemisphere_picture(const CubeMips& mips, double side, int size, int border) {
  const int edge = size + 2 * border;
  PlanePicture picture{Image(edge, edge, 4), static_cast<double>(edge) / size};
  parallel_for(static_cast<std::size_t>(edge), 4, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < edge; ++x) {
        float* texel = picture.texels.at(x, y);
        for (int k = 0; k < 4; ++k) {
          const double a = (2 * (x - border) + (k & 1 ? 1.5 : 0.5)) / size - 1;
          const double b = 1 - (2 * (y - border) + (k & 2 ? 1.5 : 0.5)) / size;
          const double angle = 2.0 / size * (2 / (1 + a * a + b * b)) / 2;  // between the four
          float rgb[3];
          look_up_cube(mips, paraboloid_direction(a, b, side), std::log2(angle * mips.size() / 2), rgb);
          for (int c = 0; c < 3; ++c) texel[c] += 0.25f * rgb[c];
        }
        texel[3] = 1;
      }
  });
  return picture;
}

// The lobe around the middle of a picture, magnified: K(angle) times solid angle, angle = 2 atan(r), 1 - cos =
// 2 r^2 / (1 + r^2). At the rim it looks nearly the same, twice as large.
PlaneKernel lobe_in_picture(const ZonalKernel& kernel, double magnification) {
  const double reach = std::min(2.0, std::tan(0.5 * KernelQuantiles(kernel).angle_with_tail(1e-3)));
  const auto weight = [kernel, magnification](double dx, double dy) {
    const double r2 = (dx * dx + dy * dy) / (magnification * magnification), scale = 1 / (1 + r2);
    return evaluate(kernel, 2 * r2 * scale) * scale * scale;
  };
  return {weight, magnification * angular_width(kernel) / 2, magnification * reach};
}

// A hemisphere filtered by both kernels, over the disc and a texel around it.
struct Filtered {
  Image smallest, largest;
};

void look_up(const Image& picture, int size, double a, double b, double weight, double* rgb) {
  const double x = (a + 1) * 0.5 * size + 0.5, y = (1 - b) * 0.5 * size + 0.5;  // one texel of margin
  const int x0 = std::clamp(static_cast<int>(x), 0, picture.width - 2);
  const int y0 = std::clamp(static_cast<int>(y), 0, picture.height - 2);
  const double fx = x - x0, fy = y - y0;
  for (int c = 0; c < 3; ++c) {
    const double above = (1 - fx) * static_cast<double>(picture.at(x0, y0)[c]) +
                         fx * static_cast<double>(picture.at(x0 + 1, y0)[c]);
    const double below = (1 - fx) * static_cast<double>(picture.at(x0, y0 + 1)[c]) +
                         fx * static_cast<double>(picture.at(x0 + 1, y0 + 1)[c]);
    rgb[c] += weight * ((1 - fy) * above + fy * below);
  }
}

}  // namespace

// The blend has the variance of the lobe that belongs there: with the smallest 1 and the largest 4,
// (1 + r^2)^2 = 1 + 3 share.
Cube filter_paraboloid(const Image& radiance, const FilterTarget& target, const ParaboloidOptions& options) {
  if (!(options.border <= 3)) throw Error("the border of a paraboloid must not be wider than 3 radii");
  const Sizes sizes = disc_sizes(radiance, target.kernel);
  const PlaneKernel smallest = lobe_in_picture(target.kernel, 1), largest = lobe_in_picture(target.kernel, 2);
  const double border = options.border < 0 ? std::min(2.0, largest.reach) : options.border;
  const int step = std::min(32, sizes.source);  // the pictures' coarser copies need even sizes
  const int border_texels = (static_cast<int>(std::ceil(border * sizes.source / 2)) + step - 1) / step * step;
  const CubeMips mips = build_mips(working_cube(radiance, std::max(8, sizes.source / 2)));
  std::array<Filtered, 2> sides;
  for (std::size_t k = 0; k < 2; ++k) {
    const PlanePicture picture = hemisphere_picture(mips, k == 0 ? 1 : -1, sizes.source, border_texels);
    const int result = sizes.result + 2;
    const double half_width = static_cast<double>(result) / sizes.result;
    sides[k] = {filter_plane(picture, smallest, result, half_width),
                filter_plane(picture, largest, result, half_width)};
  }
  return cube_from_directions(target, [&](Vec3 d, double* rgb) {
    const Filtered& side = sides[d.z < 0];
    const double a = d.x / (1 + std::abs(d.z)), b = d.y / (1 + std::abs(d.z));
    const double growth = 1 + a * a + b * b, share = (growth * growth - 1) / 3;
    look_up(side.smallest, sizes.result, a, b, 1 - share, rgb);
    look_up(side.largest, sizes.result, a, b, share, rgb);
  });
}

}  // namespace welkin
