#include <welkin/sphere/cube_mips.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/mapping.h>

namespace welkin {
namespace {

// The part of [from, to] of a coarse texel that a fine texel covers, in s or t.
struct Overlap {
  int fine = 0;
  double from = 0, to = 0;
};

// The fine texels that a coarse one meets. With n = size / coarse_size not whole, edges are shared out exactly.
std::vector<Overlap> overlaps(int fine_size, int coarse_size, int coarse) {
  std::vector<Overlap> result;
  const double begin = 2.0 * coarse / coarse_size - 1, end = 2.0 * (coarse + 1) / coarse_size - 1;
  const int first = static_cast<int>(static_cast<long long>(coarse) * fine_size / coarse_size);
  for (int fine = first; fine < fine_size; ++fine) {
    const double from = std::max(begin, 2.0 * fine / fine_size - 1);
    const double to = std::min(end, 2.0 * (fine + 1) / fine_size - 1);
    if (to > from) result.push_back({fine, from, to});
    if (to >= end) break;
  }
  return result;
}

double solid_angle(Overlap s, Overlap t) {
  const auto corner = [](double a, double b) { return std::atan2(a * b, std::sqrt(1 + a * a + b * b)); };
  return corner(s.to, t.to) - corner(s.from, t.to) - corner(s.to, t.from) + corner(s.from, t.from);
}

// One row of a coarse face; every face has the same solid angles.
void reduce_row(const Cube& fine, Cube& coarse, int y) {
  const auto rows = overlaps(fine.size, coarse.size, y);
  std::vector<double> sum(static_cast<std::size_t>(6 * fine.channels));
  for (int x = 0; x < coarse.size; ++x) {
    std::fill(sum.begin(), sum.end(), 0.0);
    double total = 0;
    for (const Overlap& s : overlaps(fine.size, coarse.size, x)) {
      for (const Overlap& t : rows) {
        const double weight = solid_angle(s, t);
        total += weight;
        for (std::size_t k = 0; k < sum.size(); ++k) {
          const int face = static_cast<int>(k) / fine.channels, channel = static_cast<int>(k) % fine.channels;
          sum[k] += weight * fine.at(face, s.fine, t.fine)[channel];
        }
      }
    }
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const int face = static_cast<int>(k) / fine.channels, channel = static_cast<int>(k) % fine.channels;
      coarse.at(face, x, y)[channel] = static_cast<float>(sum[k] / total);
    }
  }
}

// The same for an even fine size, where a coarse texel is four fine ones: a fine row's solid angles share their corners.
void reduce_even_row(const Cube& fine, Cube& coarse, int y) {
  const MapShape shape = map_shape(Mapping::cube, fine.size);
  std::vector<double> upper, lower;
  map_row_solid_angles(shape, 2 * y, upper);
  map_row_solid_angles(shape, 2 * y + 1, lower);
  for (int x = 0; x < coarse.size; ++x) {
    const auto left = static_cast<std::size_t>(2 * x);
    const double weight[4] = {upper[left], upper[left + 1], lower[left], lower[left + 1]};
    const double scale = 1 / (weight[0] + weight[1] + weight[2] + weight[3]);
    for (int face = 0; face < 6; ++face) {
      const float* a = fine.at(face, 2 * x, 2 * y);
      const float* b = fine.at(face, 2 * x, 2 * y + 1);
      float* out = coarse.at(face, x, y);
      for (int c = 0; c < fine.channels; ++c) {
        const double sum = weight[0] * a[c] + weight[1] * a[c + fine.channels] + weight[2] * b[c] +
                           weight[3] * b[c + fine.channels];
        out[c] = static_cast<float>(scale * sum);
      }
    }
  }
}

}  // namespace

CubeMips build_mips(Cube cube, int levels) {
  CubeMips mips;
  int size = cube.size;
  mips.levels.push_back(std::move(cube));
  while (size > 1 && (levels <= 0 || static_cast<int>(mips.levels.size()) < levels)) {
    size /= 2;
    const Cube& fine = mips.levels.back();
    Cube coarse(size, fine.channels);
    parallel_for(static_cast<std::size_t>(size), 4, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        fine.size % 2 == 0 ? reduce_even_row(fine, coarse, y) : reduce_row(fine, coarse, y);
      }
    });
    mips.levels.push_back(std::move(coarse));
  }
  return mips;
}

}  // namespace welkin
