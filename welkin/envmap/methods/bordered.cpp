#include <welkin/envmap/methods/bordered.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/envmap/methods/planar_filter.h>
#include <welkin/envmap/methods/working_cube.h>
#include <welkin/error.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

// The size of the faces that are filtered: fine enough for the kernel, and a multiple of the target's (or a part of
// it, down to an eighth) by a power of two, so that the two grids repeat against each other.
int face_size(const Image& radiance, const FilterTarget& target) {
  const int wanted = working_cube_size(radiance, target.kernel, 8);
  int size = target.size;
  while (size < wanted) size *= 2;
  while (size % 2 == 0 && size / 2 >= wanted && size > target.size / 8) size /= 2;
  return size;
}

// A texel of a cube by its place.
struct Place {
  int face = 0, x = 0, y = 0;
};

// The cube's texel at (x, y) of a face's picture, border included. The neighbour across an edge is folded out: beyond
// s = 1 + e the ray is that of the point at distance e from the edge, on the neighbour.
std::optional<Place> folded_texel(int n, int face, int x, int y) {
  const auto inside = [n](int i) { return i >= 0 && i < n; };
  if (inside(x) && inside(y)) return Place{face, x, y};
  if (!inside(x) && !inside(y)) return std::nullopt;
  const Vec3 middle = cube_ray({face, 0, 0});
  const double s = (2 * x + 1.0) / n - 1, t = (2 * y + 1.0) / n - 1;
  const double beyond = std::max(std::abs(s), std::abs(t)) - 1;
  const Vec3 on_edge = cube_ray({face, std::clamp(s, -1.0, 1.0), std::clamp(t, -1.0, 1.0)});
  const CubePoint point = cube_point(on_edge - beyond * middle);
  const auto texel = [n](double v) { return std::clamp(static_cast<int>((v + 1) * 0.5 * n), 0, n - 1); };
  return Place{point.face, texel(point.s), texel(point.t)};
}

// Texels weigh alike, or by their solid angle over that in the middle of a face.
PlanePicture face_picture(const Cube& cube, int face, int border, bool solid_angles) {
  const int side = cube.size + 2 * border;
  const double middle = 4.0 / (cube.size * cube.size);
  PlanePicture picture{Image(side, side, 4), static_cast<double>(side) / cube.size};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const std::optional<Place> place = folded_texel(cube.size, face, x - border, y - border);
      if (!place) continue;
      const float weight =
          solid_angles ? static_cast<float>(cube_texel_solid_angle(cube.size, place->x, place->y) / middle)
                       : 1;
      float* out = picture.texels.at(x, y);
      for (int c = 0; c < 3; ++c) out[c] = weight * cube.at(place->face, place->x, place->y)[c];
      out[3] = weight;
    }
  return picture;
}

// A solid angle of the face's plane at distance r from its middle is cos^3 of an area.
PlaneKernel lobe_at_middle(const ZonalKernel& kernel, bool solid_angles) {
  const double reach = std::tan(std::min(1.4, KernelQuantiles(kernel).angle_with_tail(1e-3)));
  const int power = solid_angles ? 0 : 3;  // else texels bring their own
  const auto weight = [kernel, power](double dx, double dy) {
    const double r2 = dx * dx + dy * dy, cosine = 1 / std::sqrt(1 + r2);
    return evaluate(kernel, r2 * cosine / (1 + 1 / cosine)) * std::pow(cosine, power);
  };
  return {weight, angular_width(kernel), reach};
}

// The square whose deviation along an axis is the kernel's spread: a third of the square of half its side.
PlaneKernel square_of_spread(const ZonalKernel& kernel) {
  const double half_side = std::sqrt(3.0) * kernel_spread(kernel);
  return {[](double, double) { return 1.0; }, half_side, half_side, false};
}

}  // namespace

Cube filter_bordered(const Image& radiance, const FilterTarget& target, const BorderedOptions& options) {
  if (!(options.border <= 1)) throw Error("the border of a face must not be wider than 1 face");
  const PlaneKernel kernel =
      options.box ? square_of_spread(target.kernel) : lobe_at_middle(target.kernel, options.solid_angles);
  const Cube source = working_cube(radiance, face_size(radiance, target));
  const double wanted = options.border < 0 ? std::min(1.0, kernel.reach / 2) : options.border;
  // A multiple of 32 where it is wide: the picture's coarser copies need even sizes.
  int border = std::min(source.size, static_cast<int>(std::ceil(wanted * source.size)));
  const int step = std::min(32, source.size);
  if (border > 0 && options.border < 0) border = std::min(source.size, (border + step - 1) / step * step);
  Cube result(target.size);
  for (int face = 0; face < 6; ++face) {
    const Image filtered =
        filter_plane(face_picture(source, face, border, options.solid_angles), kernel, target.size, 1);
    for (std::size_t i = 0; i < filtered.pixels.size(); ++i)
      result.at(face, 0, 0)[i] = static_cast<float>(target.scale) * filtered.pixels[i];
  }
  return result;
}

}  // namespace welkin
