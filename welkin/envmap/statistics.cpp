#include <welkin/envmap/statistics.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

struct RowSums {
  std::array<double, 3> energy{}, up{}, down{};
  double min = std::numeric_limits<double>::infinity(), max = -std::numeric_limits<double>::infinity();
  double brightest = -std::numeric_limits<double>::infinity();
  int x = 0, y = 0;
};

double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

// The integral of max(0, cos theta) sin theta over a row, exactly: half the difference of sin^2 theta, for the part of
// the row above the horizon.
double cosine_weight(int height, int row) {
  const double from = std::min(pi / 2, pi * row / height), to = std::min(pi / 2, pi * (row + 1) / height);
  return 0.5 * (std::sin(to) * std::sin(to) - std::sin(from) * std::sin(from));
}

void add_row(const Image& map, int y, RowSums& sums) {
  std::array<double, 3> row{};
  for (int x = 0; x < map.width; ++x) {
    const float* p = map.at(x, y);
    for (int c = 0; c < 3; ++c) {
      row[c] += static_cast<double>(p[c]);
      sums.min = std::min(sums.min, static_cast<double>(p[c]));
      sums.max = std::max(sums.max, static_cast<double>(p[c]));
    }
    if (const double l = luminance(p); l > sums.brightest) {
      sums.brightest = l;
      sums.x = x;
      sums.y = y;
    }
  }
  const double step = 2 * pi / map.width;
  for (int c = 0; c < 3; ++c) {
    sums.energy[c] += row[c] * equirect_texel_solid_angle(map.width, map.height, y);
    sums.up[c] += row[c] * step * cosine_weight(map.height, y);
    sums.down[c] += row[c] * step * cosine_weight(map.height, map.height - 1 - y);
  }
}

}  // namespace

MapStatistics map_statistics(const Image& radiance) {
  assert(radiance.channels == 3 && !radiance.empty());
  const auto parts =
      parallel_partials<RowSums>(radiance.height, 16, [&](RowSums& sums, std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) add_row(radiance, static_cast<int>(y), sums);
      });
  RowSums all;
  for (const RowSums& part : parts) {
    for (int c = 0; c < 3; ++c) {
      all.energy[c] += part.energy[c];
      all.up[c] += part.up[c];
      all.down[c] += part.down[c];
    }
    all.min = std::min(all.min, part.min);
    all.max = std::max(all.max, part.max);
    if (part.brightest > all.brightest) {
      all.brightest = part.brightest;
      all.x = part.x;
      all.y = part.y;
    }
  }
  MapStatistics result;
  result.energy = all.energy;
  for (int c = 0; c < 3; ++c) result.mean_radiance[c] = all.energy[c] / (4 * pi);
  result.irradiance_up = all.up;
  result.irradiance_down = all.down;
  result.min_radiance = all.min;
  result.max_radiance = all.max;
  result.brightest_x = all.x;
  result.brightest_y = all.y;
  result.brightest_luminance = all.brightest;
  result.brightest_direction =
      equirect_direction({(all.x + 0.5) / radiance.width, (all.y + 0.5) / radiance.height});
  const double energy = 0.2126 * all.energy[0] + 0.7152 * all.energy[1] + 0.0722 * all.energy[2];
  if (energy > 0)
    result.brightest_share =
        all.brightest * equirect_texel_solid_angle(radiance.width, radiance.height, all.y) / energy;
  return result;
}

}  // namespace welkin
