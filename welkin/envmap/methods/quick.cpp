#include <welkin/envmap/methods/quick.h>

#include <cmath>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/quick_taps.h>
#include <welkin/envmap/methods/spline_mips.h>
#include <welkin/envmap/methods/working_cube.h>

namespace welkin {

Cube filter_quick(const Image& radiance, const FilterTarget& target, const QuickOptions& options) {
  const SplineMips mips(working_cube(radiance, working_cube_size(radiance, target.kernel, 8)));
  const QuickTaps fit = fit_quick_taps(target.kernel, options.taps, mips.least_deviation());
  return cube_from_directions(target, [&](Vec3 up, double* rgb) {
    const double flat = std::hypot(up.x, up.z);
    const Vec3 east = flat > 0 ? Vec3{up.z / flat, 0, -up.x / flat} : Vec3{1, 0, 0};
    const Vec3 north = cross(up, east);
    for (const QuickTap& tap : fit.taps) {
      const Vec3 direction = tap.direction.x * east + tap.direction.y * north + tap.direction.z * up;
      mips.add_look_up(direction, tap.deviation, tap.weight, rgb);
    }
  });
}

}  // namespace welkin
