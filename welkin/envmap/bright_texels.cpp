#include <welkin/envmap/bright_texels.h>

#include <algorithm>
#include <cassert>
#include <numbers>
#include <tuple>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

double luminance(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// Integral over the sphere of value(luminance).
template <class Value>
double integrate_luminance(const Image& map, Value&& value) {
  const auto rows =
      parallel_partials<double>(map.height, 16, [&](double& sum, std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          double row = 0;
          for (int x = 0; x < map.width; ++x) row += value(luminance(map.at(x, y)));
          sum += row * equirect_texel_solid_angle(map.width, map.height, y);
        }
      });
  double sum = 0;
  for (double row : rows) sum += row;
  return sum;
}

struct Candidate {
  double luminance;
  int x, y;
};

std::vector<Candidate> texels_above(const Image& map, double threshold) {
  const auto parts = parallel_partials<std::vector<Candidate>>(
      map.height, 16, [&](std::vector<Candidate>& found, std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
          for (int x = 0; x < map.width; ++x)
            if (const double l = luminance(map.at(x, y)); l > threshold) found.push_back({l, x, y});
      });
  std::vector<Candidate> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

BrightSplit split_bright_texels(const Image& equirect, const BrightOptions& options) {
  assert(equirect.channels == 3);
  BrightSplit split;
  split.map = &equirect;
  split.mean = integrate_luminance(equirect, [](double l) { return l; }) / (4 * std::numbers::pi);
  split.threshold = options.threshold_over_mean * split.mean;
  std::vector<Candidate> bright = texels_above(equirect, split.threshold);
  if (static_cast<int>(bright.size()) > options.max_texels) {
    // The threshold becomes the luminance of the brightest texel that is left out.
    std::sort(bright.begin(), bright.end(), [](const Candidate& a, const Candidate& b) {
      return std::tuple(-a.luminance, a.y, a.x) < std::tuple(-b.luminance, b.y, b.x);
    });
    split.threshold = bright[options.max_texels].luminance;
    bright.resize(options.max_texels);
    std::erase_if(bright, [&](const Candidate& c) { return c.luminance <= split.threshold; });
    std::sort(bright.begin(), bright.end(), [](const Candidate& a, const Candidate& b) {
      return std::tuple(a.y, a.x) < std::tuple(b.y, b.x);
    });
  }
  for (const Candidate& c : bright) {
    BrightTexel texel{c.x,
                      c.y,
                      {},
                      equirect_texel_solid_angle(equirect.width, equirect.height, c.y),
                      equirect_patch(equirect.width, equirect.height, c.x, c.y),
                      {}};
    texel.direction = equirect_direction({(c.x + 0.5) / equirect.width, (c.y + 0.5) / equirect.height});
    const float* value = equirect.at(c.x, c.y);
    for (int i = 0; i < 3; ++i) {
      const double whole = value[i];
      texel.rest[i] = static_cast<float>(whole * (split.threshold / c.luminance));
      texel.radiance[i] = whole - static_cast<double>(texel.rest[i]);
    }
    split.texels.push_back(texel);
  }
  const auto busy = [&](double l) { return std::max(0.0, l - 4 * split.mean); };
  split.busy_flux = integrate_luminance(equirect, busy);
  for (const BrightTexel& t : split.texels)
    split.busy_flux -=
        t.solid_angle * (busy(luminance(equirect.at(t.x, t.y))) - busy(luminance(t.rest.data())));
  split.busy_flux = std::max(0.0, split.busy_flux);
  return split;
}

}  // namespace welkin
