#include <welkin/realtime/techniques/power_lobe_maps.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <numbers>

#include <welkin/envmap/reflection/lafortune_stack.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double largest_exponent = 1024;
constexpr int chain_size =
    256;  // 8 texels in the 1 / sqrt(1024) of the pi / 2 of a face that the lobe is wide
constexpr int columns = 128, rows_a_level = 4;

// Of directions at the angle a from the axis, over their azimuth: the integrals of max(0, n.l), and of that times the
// component of l along the axis and along the normal's part across it. With n.l = x + y cos(azimuth), x = (n.r) cos a,
// y = |n x r| sin a, light is above the surface for |azimuth| < open.
struct Ring {
  double sum = 0, along = 0, across = 0;
};

Ring integrate_ring(double cos_axis, double sin_axis, double cos_a) {
  const double sin_a = std::sqrt(std::max(0.0, 1 - cos_a * cos_a));
  const double x = cos_axis * cos_a, y = sin_axis * sin_a;
  const double open = x >= y ? pi : x <= -y ? 0 : std::acos(-x / y);
  const double sum = 2 * (x * open + y * std::sin(open));
  const double first = 2 * (x * std::sin(open) + y * (open / 2 + std::sin(2 * open) / 4));
  return {sum, cos_a * sum, sin_a * first};
}

// The exponent that stands at a fractional level.
double exponent_of(const std::vector<double>& exponents, double level) {
  const std::size_t k = std::min(static_cast<std::size_t>(level), exponents.size() - 2);
  const double share = level - static_cast<double>(k);
  const double spread = (1 - share) / (exponents[k] + 2) + share / (exponents[k + 1] + 2);
  return 1 / spread - 2;
}

Image moment_table(const std::vector<double>& exponents) {
  const int rows = rows_a_level * (static_cast<int>(exponents.size()) - 1) + 1;
  Image table(columns, rows, 3);
  for (int row = 0; row < rows; ++row) {
    const double exponent = exponent_of(exponents, static_cast<double>(row) / rows_a_level);
    for (int column = 0; column < columns; ++column) {
      const MomentLobe lobe = moment_lobe(2.0 * column / (columns - 1) - 1, exponent);
      float* texel = table.at(column, row);
      texel[0] = static_cast<float>(lobe.energy);
      texel[1] = static_cast<float>(lobe.lean);
      texel[2] = static_cast<float>(1 - lobe.mean_cosine);
    }
  }
  return table;
}

// The last chain that was made, because several techniques look up the same one and people switch between them.
class LastChain {
 public:
  std::shared_ptr<const LafortuneStack> of(const Image& radiance) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t hash = hash_of(radiance);
    if (!stack_ || hash != hash_)
      stack_ =
          std::make_shared<LafortuneStack>(prepare_lafortune_stack(radiance, {largest_exponent, chain_size}));
    hash_ = hash;
    return stack_;
  }

 private:
  // FNV-1a over the floats' bits, eight bytes at a time.
  static std::uint64_t hash_of(const Image& image) {
    std::uint64_t hash = 14695981039346656037u ^ static_cast<std::uint64_t>(image.width);
    const std::size_t pairs = image.pixels.size() / 2;
    for (std::size_t i = 0; i <= pairs; ++i) {
      std::uint64_t word = 0;
      const std::size_t floats = std::min<std::size_t>(2, image.pixels.size() - 2 * i);
      if (floats > 0) std::memcpy(&word, &image.pixels[2 * i], floats * sizeof(float));
      hash = (hash ^ word) * 1099511628211u;
    }
    return hash;
  }

  std::mutex mutex_;
  std::uint64_t hash_ = 0;
  std::shared_ptr<const LafortuneStack> stack_;
};

LastChain& last_chain() {
  static LastChain chain;
  return chain;
}

}  // namespace

// With t = cos^(N + 1) a, (N + 1) cos^N a sin a da = -dt: the lobe becomes the uniform weight of t in [0, 1].
MomentLobe moment_lobe(double cos_axis, double exponent) {
  constexpr int nodes = 256;
  const double sin_axis = std::sqrt(std::max(1e-12, 1 - cos_axis * cos_axis));
  Ring total;
  for (int i = 0; i < nodes; ++i) {
    const Ring ring = integrate_ring(cos_axis, sin_axis, std::pow((i + 0.5) / nodes, 1 / (exponent + 1)));
    total.sum += ring.sum / (2 * pi * nodes);
    total.along += ring.along / (2 * pi * nodes);
    total.across += ring.across / (2 * pi * nodes);
  }
  if (total.sum < 1e-9) return {0, 0, (exponent + 1) / (exponent + 2)};
  const double size = std::hypot(total.along, total.across);
  const double lean = total.across / std::max(total.along, 0.05 * size) / sin_axis;
  return {total.sum, lean, std::min(size / total.sum, 1.0)};
}

void PowerLobeMaps::prepare(const Frame& frame) {
  if (made_for_ == frame.environment.upload && chain_) return;
  const std::shared_ptr<const LafortuneStack> stack = last_chain().of(frame.light.radiance);
  chain_ = upload_cube(stack->glossy, TexelFormat::rgba16f);
  levels_ = static_cast<int>(stack->exponents.size());
  if (!moments_) moments_ = upload_image(moment_table(stack->exponents), {}, false);
  made_for_ = frame.environment.upload;
}

void PowerLobeMaps::bind(const Program& program, int first_unit) const {
  program.set_texture("power_map", first_unit, GL_TEXTURE_CUBE_MAP, chain_);
  program.set_texture("power_moments", first_unit + 1, GL_TEXTURE_2D, moments_);
  program.set("power_last_level", static_cast<float>(levels_ - 1));
  program.set("power_largest_exponent", static_cast<float>(largest_exponent));
}

}  // namespace welkin
