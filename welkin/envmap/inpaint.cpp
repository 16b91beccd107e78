#include <welkin/envmap/inpaint.h>

#include <algorithm>
#include <array>
#include <vector>

#include <welkin/envmap/laplace_solver.h>

namespace welkin {
namespace {

// Beyond a pole lies the column half way round. An odd width has none there: such a texel is its own neighbour, so that
// neighbours stay mutual.
std::array<std::uint32_t, 4> neighbours_of(const Image& map, std::uint32_t texel) {
  const auto width = static_cast<std::uint32_t>(map.width), height = static_cast<std::uint32_t>(map.height);
  const std::uint32_t x = texel % width, y = texel / width;
  const std::uint32_t across = width % 2 == 0 ? (x + width / 2) % width : x;
  const auto index = [&](std::uint32_t i, std::uint32_t j) { return j * width + i; };
  return {index((x + width - 1) % width, y), index((x + 1) % width, y),
          y > 0 ? index(x, y - 1) : index(across, y), y + 1 < height ? index(x, y + 1) : index(across, y)};
}

struct Hole {
  std::vector<std::uint32_t> texels;  // ascending
  std::vector<LaplaceTexel> unknowns;

  Hole(const Image& map, std::span<const std::uint32_t> named) : texels(named.begin(), named.end()) {
    std::sort(texels.begin(), texels.end());
    unknowns.reserve(texels.size());
    for (std::uint32_t t : texels) {
      LaplaceTexel& unknown =
          unknowns.emplace_back(LaplaceTexel{t % map.width, t / map.width, neighbours_of(map, t)});
      for (std::uint32_t& n : unknown.neighbours) n = number_of(n);
    }
  }

  std::uint32_t number_of(std::uint32_t texel) const {
    const auto found = std::lower_bound(texels.begin(), texels.end(), texel);
    return found != texels.end() && *found == texel ? static_cast<std::uint32_t>(found - texels.begin())
                                                    : LaplaceTexel::known;
  }
};

struct Surroundings {
  double mean = 0;
  float least = 0, most = 0;
  std::vector<double> sums;  // of each unknown's known neighbours
};

Surroundings look_around(const Image& map, const Hole& hole, int channel) {
  Surroundings s;
  s.sums.resize(hole.texels.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < hole.texels.size(); ++i) {
    const auto around = neighbours_of(map, hole.texels[i]);
    for (int k = 0; k < 4; ++k) {
      if (hole.unknowns[i].neighbours[k] != LaplaceTexel::known) continue;
      const float value = map.pixels[3 * std::size_t{around[k]} + channel];
      s.least = count == 0 ? value : std::min(s.least, value);
      s.most = count == 0 ? value : std::max(s.most, value);
      s.sums[i] += static_cast<double>(value);
      s.mean += static_cast<double>(value);
      ++count;
    }
  }
  s.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
  return s;
}

}  // namespace

void inpaint(Image& equirect, std::span<const std::uint32_t> texels) {
  if (texels.empty() || texels.size() == static_cast<std::size_t>(equirect.width) * equirect.height) return;
  const Hole hole(equirect, texels);
  LaplaceSolver solver(hole.unknowns);
  for (int c = 0; c < 3; ++c) {
    const Surroundings s = look_around(equirect, hole, c);
    std::vector<double> filled(hole.texels.size(), s.mean);
    solver.solve(s.sums, 1e-5 * static_cast<double>(s.most), filled);
    for (std::size_t i = 0; i < filled.size(); ++i)
      equirect.pixels[3 * std::size_t{hole.texels[i]} + c] =
          std::clamp(static_cast<float>(filled[i]), s.least, s.most);
  }
}

}  // namespace welkin
