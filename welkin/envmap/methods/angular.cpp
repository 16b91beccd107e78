#include <welkin/envmap/methods/angular.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/error.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// A face's own frame: a point (s, t) of it is normal + s s_axis + t t_axis.
struct FaceFrame {
  Vec3 normal, s_axis, t_axis;
};

FaceFrame face_frame(int face) {
  const Vec3 normal = cube_ray({face, 0, 0});
  return {normal, cube_ray({face, 1, 0}) - normal, cube_ray({face, 0, 1}) - normal};
}

struct Range {
  int first = 0, last = -1;  // empty when last < first
};

// The texels whose coordinate may be met by a cap of angle `radius`. Seen from the pole `away` (the face's other axis), the
// cap covers the longitudes lambda +- asin(sin radius / sin polar), all of them where it holds a pole; the coordinate is the tangent of the
// longitude, and the face lies within +-45 degrees.
Range coordinate_range(double along, double normal, double away, double radius, int size) {
  const double sine = std::hypot(along, normal);  // of the polar angle
  double half = pi;
  if (radius < pi / 2 && std::sin(radius) < sine) half = std::asin(std::sin(radius) / sine);
  if (std::abs(std::atan2(sine, away)) <= radius || std::abs(std::atan2(sine, -away)) <= radius) half = pi;
  const double longitude = std::atan2(along, normal);
  if (half >= pi) return {0, size - 1};
  const double low = std::max(-pi / 4, longitude - half), high = std::min(pi / 4, longitude + half);
  if (low > high) return {};
  const auto texel = [size](double angle) { return (std::tan(angle) + 1) / 2 * size; };
  return {std::clamp(static_cast<int>(std::floor(texel(low))) - 1, 0, size - 1),
          std::clamp(static_cast<int>(std::floor(texel(high))) + 1, 0, size - 1)};
}

WELKIN_TARGET_CLONES void one_minus_cosines(double start, double step, const double* inverse_length,
                                            double* u, int count) {
  for (int i = 0; i < count; ++i) u[i] = std::max(0.0, 1 - (start + step * i) * inverse_length[i]);
}

class CapSum {
 public:
  CapSum(const Cube& source, const ZonalKernel& kernel, double radius)
      : source_(source), kernel_(kernel), radius_(radius), end_(1 - std::cos(radius)) {
    const int n = source.size;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        inverse_length_.push_back(1 / length(cube_ray({0, centre(x), centre(y)})));
        solid_angle_.push_back(cube_texel_solid_angle(n, x, y));
      }
  }

  void operator()(Vec3 direction, double* rgb) const {
    double sums[4] = {};
    for (int face = 0; face < 6; ++face) add_face(face, direction, sums);
    // A cap that holds no texel's centre: the texel that it lies in.
    if (!(sums[3] > 0)) return nearest(direction, rgb);
    for (int c = 0; c < 3; ++c) rgb[c] = sums[c] / sums[3];
  }

 private:
  double centre(int x) const { return (2 * x + 1.0) / source_.size - 1; }

  void add_face(int face, Vec3 direction, double* sums) const {
    const FaceFrame frame = face_frame(face);
    const double n = dot(direction, frame.normal), s = dot(direction, frame.s_axis),
                 t = dot(direction, frame.t_axis);
    if (n < std::cos(std::min(pi, radius_ + 0.9553166181245093))) return;  // a corner is 54.74 degrees off
    const Range columns = coordinate_range(s, n, t, radius_, source_.size);
    const Range rows = coordinate_range(t, n, s, radius_, source_.size);
    const int count = columns.last - columns.first + 1;
    if (count <= 0) return;
    std::vector<double> u(static_cast<std::size_t>(count)), values(static_cast<std::size_t>(count));
    for (int y = rows.first; y <= rows.last; ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * source_.size + columns.first;
      one_minus_cosines(n + t * centre(y) + s * centre(columns.first), 2 * s / source_.size,
                        &inverse_length_[first], u.data(), count);
      add_row(source_.at(face, columns.first, y), &solid_angle_[first], u, values, sums);
    }
  }

  // The cap is one run of the row (a cone meets a line in one piece), or none. Beyond 90 degrees what is cut off may be
  // a run inside the row; it stays.
  void add_row(const float* texels, const double* solid_angle, const std::vector<double>& u,
               std::vector<double>& values, double* sums) const {
    std::size_t begin = 0, end = u.size();
    while (begin < end && u[begin] > end_) ++begin;
    while (end > begin && u[end - 1] > end_) --end;
    evaluate(kernel_, std::span(u).subspan(begin, end - begin), std::span(values).first(end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      const double w = values[i - begin] * solid_angle[i];
      for (int c = 0; c < 3; ++c) sums[c] += w * static_cast<double>(texels[3 * i + c]);
      sums[3] += w;
    }
  }

  void nearest(Vec3 direction, double* rgb) const {
    const CubePoint p = cube_point(direction);
    const auto texel = [this](double s) {
      return std::min(source_.size - 1, static_cast<int>((s + 1) / 2 * source_.size));
    };
    const float* at = source_.at(p.face, texel(p.s), texel(p.t));
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<double>(at[c]);
  }

  const Cube& source_;
  const ZonalKernel& kernel_;
  double radius_, end_;
  std::vector<double> inverse_length_, solid_angle_;  // of a face's texels
};

}  // namespace

Cube filter_angular(const Image& radiance, const FilterTarget& target, const AngularOptions& options) {
  if (!(options.cut_energy >= 1e-9 && options.cut_energy <= 0.5))
    throw Error("angular: the energy cut off is 1e-9 to 0.5");
  if (options.source_size < 0 || options.source_size > 4096)
    throw Error("angular: the source's size is 1 to 4096");
  const Cube source = equirect_to_cube(
      radiance, options.source_size > 0 ? options.source_size : matching_cube_size(radiance));
  const CapSum cap(source, target.kernel, KernelQuantiles(target.kernel).angle_with_tail(options.cut_energy));
  return cube_from_directions(
      target, [&](Vec3 direction, double* rgb) { cap(direction, rgb); }, options.progress);
}

}  // namespace welkin
