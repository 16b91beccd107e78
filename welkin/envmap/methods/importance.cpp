#include <welkin/envmap/methods/importance.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/error.h>
#include <welkin/sampling/sequence.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

void check(const ImportanceOptions& options) {
  if (options.samples < 1 || options.samples > 1 << 20) throw Error("importance: samples are 1 to 1048576");
  if (!(std::abs(options.level_bias) <= 16)) throw Error("importance: the level bias is -16 to 16");
  if (options.source_size < 0 || options.source_size > 4096)
    throw Error("importance: the source's size is 1 to 4096");
}

// A sample in the frame of the direction that is filtered.
struct LobeSample {
  double x, y, z;  // the axis is z
  double level;
};

LobeSample lobe_sample(const KernelQuantiles& quantiles, const ZonalKernel& kernel, Point2 point,
                       const ImportanceOptions& options, double texel_solid_angle) {
  const double u = quantiles.one_minus_cos(point[0]);
  const double solid_angle = 1 / (options.samples * std::max(1e-300, evaluate(kernel, u)));
  const double across = std::sqrt(u * (2 - u)), phi = 2 * pi * point[1];
  return {across * std::cos(phi), across * std::sin(phi), 1 - u,
          0.5 * std::log2(solid_angle / texel_solid_angle) + options.level_bias};
}

// Two axes at right angles to a direction (Duff et al. 2017).
struct Frame {
  Vec3 a, b;
};

Frame frame_of(Vec3 n) {
  const double sign = std::copysign(1.0, n.z), f = -1 / (sign + n.z), g = n.x * n.y * f;
  return {{1 + sign * n.x * n.x * f, sign * g, -sign * n.x}, {g, sign + n.y * n.y * f, -n.y}};
}

std::uint64_t bits_of(Vec3 direction, std::uint32_t seed) {
  std::uint64_t bits = seed;
  for (double value : {direction.x, direction.y, direction.z}) {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    bits = mix_bits(bits ^ word);
  }
  return bits;
}

double fraction(double value) { return value - std::floor(value); }

class ImportanceSum {
 public:
  ImportanceSum(const CubeMips& source, const ZonalKernel& kernel, const ImportanceOptions& options)
      : source_(source), kernel_(kernel), options_(options), quantiles_(kernel) {
    texel_ = 4 * pi / (6.0 * source.size() * source.size());
    for (int i = 0; i < options.samples; ++i)
      samples_.push_back(lobe_sample(quantiles_, kernel, point(i), options, texel_));
  }

  void operator()(Vec3 direction, double* rgb) const {
    const Frame frame = frame_of(direction);
    const std::uint64_t bits = bits_of(direction, options_.seed);
    for (int i = 0; i < options_.samples; ++i) {
      const LobeSample s = options_.scramble ? scrambled(i, bits) : samples_[static_cast<std::size_t>(i)];
      const Vec3 at = s.z * direction + s.x * frame.a + s.y * frame.b;
      float value[3];
      look_up_cube(source_, at, s.level, value);
      for (int c = 0; c < 3; ++c) rgb[c] += static_cast<double>(value[c]) / options_.samples;
    }
  }

 private:
  // The middle of each share, so that the first sample is not the axis itself.
  Point2 point(int i) const {
    const auto count = static_cast<std::uint64_t>(options_.samples);
    const Point2 p = hammersley_point(static_cast<std::uint64_t>(i), count);
    return {p[0] + 0.5 / options_.samples, p[1]};
  }

  // Both coordinates shifted on the torus (Cranley & Patterson 1976).
  LobeSample scrambled(int i, std::uint64_t bits) const {
    constexpr double scale = 1 / 4294967296.0;
    const Point2 p = point(i);
    const Point2 shifted{fraction(p[0] + static_cast<double>(bits >> 32) * scale),
                         fraction(p[1] + static_cast<double>(bits & 0xffffffffu) * scale)};
    return lobe_sample(quantiles_, kernel_, shifted, options_, texel_);
  }

  const CubeMips& source_;
  const ZonalKernel& kernel_;
  ImportanceOptions options_;
  KernelQuantiles quantiles_;
  double texel_ = 0;  // solid angle of one of the source's texels, on average
  std::vector<LobeSample> samples_;
};

}  // namespace

Cube filter_importance(const Image& radiance, const FilterTarget& target, const ImportanceOptions& options) {
  check(options);
  const int size = options.source_size > 0 ? options.source_size : matching_cube_size(radiance);
  const CubeMips source = build_mips(equirect_to_cube(radiance, size));
  const ImportanceSum sum(source, target.kernel, options);
  return cube_from_directions(target, [&](Vec3 direction, double* rgb) { sum(direction, rgb); });
}

}  // namespace welkin
