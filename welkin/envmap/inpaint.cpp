#include <welkin/envmap/inpaint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace welkin {
namespace {

using Neighbours = std::array<std::uint32_t, 4>;

Neighbours neighbours_of(const Image& map, std::uint32_t texel) {
  const auto width = static_cast<std::uint32_t>(map.width), height = static_cast<std::uint32_t>(map.height);
  const std::uint32_t x = texel % width, y = texel / width, across = (x + width / 2) % width;
  const auto index = [&](std::uint32_t i, std::uint32_t j) { return j * width + i; };
  return {index((x + width - 1) % width, y), index((x + 1) % width, y),
          y > 0 ? index(x, y - 1) : index(across, y), y + 1 < height ? index(x, y + 1) : index(across, y)};
}

struct Surroundings {
  std::array<float, 3> mean{};
  float largest = 0;
  std::size_t count = 0;
};

Surroundings look_around(const Image& map, std::span<const Neighbours> around,
                         const std::vector<bool>& inside) {
  Surroundings s;
  std::array<double, 3> sum{};
  for (const Neighbours& four : around)
    for (std::uint32_t n : four) {
      if (inside[n]) continue;
      ++s.count;
      for (int c = 0; c < 3; ++c) {
        const float value = map.pixels[3 * std::size_t{n} + c];
        sum[c] += static_cast<double>(value);
        s.largest = std::max(s.largest, value);
      }
    }
  for (int c = 0; c < 3; ++c)
    s.mean[c] = static_cast<float>(sum[c] / static_cast<double>(std::max<std::size_t>(s.count, 1)));
  return s;
}

// One sweep of successive over-relaxation; returns the largest correction.
float relax(Image& map, std::span<const std::uint32_t> texels, std::span<const Neighbours> around,
            float factor) {
  float largest = 0;
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      float mean = 0;
      for (std::uint32_t n : around[i]) mean += 0.25f * map.pixels[3 * std::size_t{n} + c];
      float& value = map.pixels[3 * std::size_t{texels[i]} + c];
      const float step = factor * (mean - value);
      value = std::max(0.0f, value + step);
      largest = std::max(largest, std::abs(step));
    }
  return largest;
}

}  // namespace

// Over-relaxation with the factor that is best for a square of n x n unknowns, 2 / (1 + sin(pi / (n + 1))), takes about
// n sweeps a digit (Young 1971).
void inpaint(Image& equirect, std::span<const std::uint32_t> texels) {
  std::vector<bool> inside(static_cast<std::size_t>(equirect.width) * equirect.height);
  for (std::uint32_t t : texels) inside[t] = true;
  std::vector<Neighbours> around;
  around.reserve(texels.size());
  for (std::uint32_t t : texels) around.push_back(neighbours_of(equirect, t));
  const Surroundings s = look_around(equirect, around, inside);
  if (s.count == 0) return;
  for (std::uint32_t t : texels)
    for (int c = 0; c < 3; ++c) equirect.pixels[3 * std::size_t{t} + c] = s.mean[c];
  const double side = std::sqrt(static_cast<double>(texels.size()));
  const auto factor = static_cast<float>(2 / (1 + std::sin(std::numbers::pi / (side + 1))));
  const int most = 100 + static_cast<int>(20 * side);
  for (int sweep = 0; sweep < most; ++sweep)
    if (relax(equirect, texels, around, factor) <= 1e-5f * s.largest) break;
}

}  // namespace welkin
