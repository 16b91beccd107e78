#include <welkin/envmap/methods/filter_truth.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/cube_steps.h>
#include <welkin/envmap/statistics.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

void add_all(int size, FilterTruth& truth) {
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) truth.texels.push_back({face, x, y});
  truth.anywhere = truth.texels.size();
}

void choose(int size, Vec3 brightest, int count, std::uint32_t seed, FilterTruth& truth) {
  std::mt19937 random(seed);
  const auto pick = [&](int among) { return static_cast<int>(random() % static_cast<unsigned>(among)); };
  for (int i = 0; i < count; ++i) {
    const int face = pick(6), x = pick(size);
    truth.texels.push_back({face, x, pick(size)});
  }
  truth.anywhere = truth.texels.size();
  const CubePoint p = cube_point(brightest);
  const auto near = [&](double s, int offset) {
    return std::clamp(static_cast<int>((s + 1) / 2 * size) + offset, 0, size - 1);
  };
  truth.texels.push_back({p.face, near(p.s, 0), near(p.t, 0)});
  for (int i = 1; i < count / 2; ++i) {
    const int x = near(p.s, pick(9) - 4);
    truth.texels.push_back({p.face, x, near(p.t, pick(9) - 4)});
  }
}

}  // namespace

FilterTruth make_filter_truth(const Image& radiance, const FilterTarget& target, int count,
                              std::uint32_t seed) {
  FilterTruth truth;
  const MapStatistics statistics = map_statistics(radiance);
  const auto& mean = statistics.mean_radiance;
  truth.mean = target.scale * (0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2]);
  if (6LL * target.size * target.size <= count)
    add_all(target.size, truth);
  else
    choose(target.size, statistics.brightest_direction, count, seed, truth);
  std::vector<Vec3> directions;
  for (const auto& t : truth.texels)
    directions.push_back(cube_texel_direction(target.size, t.face, t.x, t.y));
  const auto start = std::chrono::steady_clock::now();
  truth.values = filter_brute_force(radiance, directions, std::span(&target.kernel, 1));
  truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (double& value : truth.values) value *= target.scale;
  return truth;
}

FilterErrors compare_with_truth(const Cube& cube, const FilterTruth& truth) {
  double squared = 0, reference = 0, largest = 0;
  for (std::size_t i = 0; i < truth.texels.size(); ++i) {
    const float* value = cube.at(truth.texels[i].face, truth.texels[i].x, truth.texels[i].y);
    for (int c = 0; c < 3; ++c) {
      const double expected = truth.values[3 * i + c], error = static_cast<double>(value[c]) - expected;
      largest = std::max(largest, std::abs(error));
      if (i >= truth.anywhere) continue;
      squared += error * error;
      reference += expected * expected;
    }
  }
  return {reference > 0 ? std::sqrt(squared / reference) : 0, truth.mean > 0 ? largest / truth.mean : 0,
          edge_step_ratio(cube)};
}

}  // namespace welkin
