#include <welkin/envmap/methods/planar_filter.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <welkin/envmap/zonal_kernel.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>

namespace welkin {
namespace {

constexpr int lanes = 16;

// sums[k mod 4] += sum of weights[k] * texels[k]; float lanes over one row, double from row to row.
WELKIN_TARGET_CLONES void add_row(const float* weights, const float* texels, int count, double* sums) {
  float part[lanes] = {};
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int k = 0; k < lanes; ++k) part[k] += weights[i + k] * texels[i + k];
  for (int k = 0; i < count; ++i, ++k) part[k] += weights[i] * texels[i];
  for (int k = 0; k < lanes; ++k) sums[k % 4] += static_cast<double>(part[k]);
}

// Where an output texel lies on the source's grid: the texel that it is in, and where in it, in steps of 2^-20.
struct GridPlace {
  int texel = 0, fraction = 0;
};

constexpr double fraction_steps = 1 << 20;

std::vector<GridPlace> grid_places(const PlanePicture& source, int size, double half_width) {
  std::vector<GridPlace> places(size);
  for (int i = 0; i < size; ++i) {
    const double position = ((2 * i + 1.0) / size - 1) * half_width;
    const double x = (position / source.half_width + 1) / 2 * source.texels.width;
    const double steps = std::round(x * fraction_steps);
    places[i].texel = static_cast<int>(std::floor(steps / fraction_steps));
    places[i].fraction = static_cast<int>(steps - places[i].texel * fraction_steps);
  }
  return places;
}

// One part of a kernel: its core, or a ring around it.
struct Part {
  double inner = 0, outer = 0;  // windows of core_share; 0: not cut there
  double reach = 0;             // of this part alone
};

double part_weight(const PlaneKernel& kernel, const Part& part, double dx, double dy) {
  if (std::abs(dx) > part.reach || std::abs(dy) > part.reach) return 0;
  const double distance = std::hypot(dx, dy);
  double window = part.outer > 0 ? core_share(distance / part.outer) : 1;
  if (part.inner > 0) window -= core_share(distance / part.inner);
  return window != 0 ? window * kernel.weight(dx, dy) : 0;
}

// The mean of the kernel over a texel at (dx, dy): one node where the kernel hardly varies, up to 16 a side at its
// peak.
double texel_weight(const PlaneKernel& kernel, const Part& part, double dx, double dy, double texel) {
  const double scale = std::max(1e-12, std::hypot(kernel.width, std::max(0.0, std::hypot(dx, dy) - texel)));
  const int nodes = std::clamp(static_cast<int>(std::ceil(4 * texel / scale)), 1,
                               part.inner > 0 || !kernel.smooth ? 4 : 16);
  double sum = 0;
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; ++i)
      sum += part_weight(kernel, part, dx + ((i + 0.5) / nodes - 0.5) * texel,
                         dy + ((j + 0.5) / nodes - 0.5) * texel);
  return sum / (nodes * nodes);
}

// Weights of the texels around one place, (2 radius + 1)^2 of them, each four times over for the four channels.
struct WeightTable {
  int radius = 0;
  std::vector<float> weights;
};

WeightTable make_table(const PlaneKernel& kernel, const Part& part, double texel, int size, int fraction_x,
                       int fraction_y) {
  WeightTable table;
  table.radius = std::min(size, static_cast<int>(std::ceil(part.reach / texel)) + 1);
  const int side = 2 * table.radius + 1;
  table.weights.resize(std::size_t{4} * side * side);
  parallel_for(static_cast<std::size_t>(side), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < side; ++x) {
        const double dx = (x - table.radius + 0.5 - fraction_x / fraction_steps) * texel;
        const double dy = (y - table.radius + 0.5 - fraction_y / fraction_steps) * texel;
        const double weight = texel_weight(kernel, part, dx, dy, texel);
        std::fill_n(&table.weights[std::size_t{4} * (y * side + x)], 4, static_cast<float>(weight));
      }
  });
  return table;
}

void add_texels(const Image& texels, const WeightTable& table, int x, int y, double* sums) {
  const int side = 2 * table.radius + 1;
  const int x0 = std::max(0, x - table.radius), x1 = std::min(texels.width, x + table.radius + 1);
  const int y0 = std::max(0, y - table.radius), y1 = std::min(texels.height, y + table.radius + 1);
  for (int row = y0; row < y1; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row - y + table.radius) * side + (x0 - x + table.radius);
    add_row(&table.weights[4 * first], texels.at(x0, row), 4 * (x1 - x0), sums);
  }
}

// Adds one part's sums of all output texels. Parts are normalised per unit area, so that levels of texels add up.
void add_part(const PlanePicture& source, const PlaneKernel& kernel, const Part& part,
              const std::vector<GridPlace>& places, std::vector<double>& sums) {
  const double texel = 2 * source.half_width / source.texels.width;
  const int size = static_cast<int>(places.size());
  std::map<std::pair<int, int>, WeightTable> tables;
  for (const GridPlace& column : places)
    for (const GridPlace& row : places) {
      const auto [entry, made] = tables.try_emplace({column.fraction, row.fraction});
      if (made)
        entry->second = make_table(kernel, part, texel, source.texels.width, column.fraction, row.fraction);
    }
  parallel_for(static_cast<std::size_t>(size), 1, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < size; ++x) {
        double texel_sums[4] = {};
        add_texels(source.texels, tables.at({places[x].fraction, places[y].fraction}), places[x].texel,
                   places[y].texel, texel_sums);
        for (int c = 0; c < 4; ++c)
          sums[std::size_t{4} * (y * size + x) + c] += texel * texel * texel_sums[c];
      }
  });
}

PlanePicture halved(const PlanePicture& fine) {
  PlanePicture coarse{Image(fine.texels.width / 2, fine.texels.height / 2, 4), fine.half_width};
  for (int y = 0; y < coarse.texels.height; ++y)
    for (int x = 0; x < coarse.texels.width; ++x)
      for (int c = 0; c < 4; ++c)
        coarse.texels.at(x, y)[c] =
            0.25f * (fine.texels.at(2 * x, 2 * y)[c] + fine.texels.at(2 * x + 1, 2 * y)[c] +
                     fine.texels.at(2 * x, 2 * y + 1)[c] + fine.texels.at(2 * x + 1, 2 * y + 1)[c]);
  return coarse;
}

}  // namespace

Image filter_plane(const PlanePicture& source, const PlaneKernel& kernel, int size, double half_width) {
  assert(source.texels.channels == 4 && source.texels.width == source.texels.height);
  constexpr int core_texels = 24, least_size = 16;
  std::vector<double> sums(std::size_t{4} * size * size);
  PlanePicture level = source;
  for (double inner = 0;;) {
    const double outer = core_texels * 2 * level.half_width / level.texels.width;
    const bool last = !kernel.smooth || outer >= kernel.reach || level.texels.width % 2 != 0 ||
                      level.texels.width < 2 * least_size;
    const Part part{inner, last ? 0 : outer, last ? kernel.reach : std::min(outer, kernel.reach)};
    add_part(level, kernel, part, grid_places(level, size, half_width), sums);
    if (last) break;
    inner = outer;
    level = halved(level);
  }
  Image result(size, size);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const double coverage = sums[4 * (i / 3) + 3];
    result.pixels[i] = coverage > 0 ? static_cast<float>(sums[4 * (i / 3) + i % 3] / coverage) : 0;
  }
  return result;
}

}  // namespace welkin
