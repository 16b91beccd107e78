#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/picture.h>

// How samples are spread over tiles and cores. A round brings every pixel to its goal; a tile is one piece of work, so
// a state between groups of tiles has whole tiles only, and what is left of a round is where count < goal.

namespace welkin::picture_loop {

inline constexpr int tile_size = 16;

inline bool finite(const PixelSample& s) {
  const auto ok = [](Rgb c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); };
  return ok(s.radiance) && ok(s.albedo) && ok({s.normal.x, s.normal.y, s.normal.z}) && std::isfinite(s.depth);
}

inline void add_sample(PictureState& state, std::size_t pixel, int replicate, const PixelSample& s) {
  double* radiance = &state.radiance_sum[3 * pixel];
  float* mean = &state.replicate_sum[3 * (pixel * picture_replicates + static_cast<std::size_t>(replicate))];
  float *albedo = &state.albedo_sum[3 * pixel], *normal = &state.normal_sum[3 * pixel];
  const float values[] = {s.radiance.r, s.radiance.g, s.radiance.b},
              albedos[] = {s.albedo.r, s.albedo.g, s.albedo.b},
              normals[] = {s.normal.x, s.normal.y, s.normal.z};
  for (int c = 0; c < 3; ++c) {
    radiance[c] += double{values[c]};
    mean[c] += values[c];
    albedo[c] += albedos[c];
    normal[c] += normals[c];
  }
  state.depth_sum[pixel] += s.coverage > 0 ? s.depth : 0.0f;
  state.coverage_sum[pixel] += s.coverage;
}

inline constexpr std::uint32_t batch_size = 16;

/// Samples begin .. begin + out.size() - 1 of a pixel, counted over its replicates in turn: all at once where `sample` can
/// do that (sample.batch(x, y, begin, out)), else one by one.
template <class Sample>
void fill_batch(int x, int y, std::uint32_t begin, std::span<PixelSample> out, const Sample& sample) {
  if constexpr (requires { sample.batch(x, y, begin, out); }) {
    sample.batch(x, y, begin, out);
  } else {
    for (std::uint32_t i = begin; i < begin + out.size(); ++i) {
      out[i - begin] = sample(x, y, static_cast<int>(i % picture_replicates), i / picture_replicates);
    }
  }
}

/// Brings one pixel to its goal, in the order of the samples' numbers; returns how many were not finite. Batches end at
/// multiples of their size, wherever a run was stopped.
template <class Sample>
std::uint64_t sample_pixel(PictureState& state, int x, int y, std::size_t pixel, const Sample& sample) {
  std::uint64_t faults = 0;
  std::array<PixelSample, batch_size> values;
  for (std::uint32_t begin = state.count[pixel], end = 0; begin < state.goal[pixel]; begin = end) {
    end = std::min((begin / batch_size + 1) * batch_size, state.goal[pixel]);
    fill_batch(x, y, begin, std::span(values.data(), end - begin), sample);
    for (std::uint32_t i = begin; i < end; ++i) {
      if (finite(values[i - begin])) {
        add_sample(state, pixel, static_cast<int>(i % picture_replicates), values[i - begin]);
      } else {
        ++faults;
      }
    }
  }
  state.count[pixel] = state.goal[pixel];
  return faults;
}

struct TileGrid {
  PictureSize size;
  std::size_t columns() const { return static_cast<std::size_t>((size.width + tile_size - 1) / tile_size); }
  std::size_t rows() const { return static_cast<std::size_t>((size.height + tile_size - 1) / tile_size); }
  std::size_t count() const { return columns() * rows(); }
};

template <class Body>
void for_each_pixel(PictureSize size, std::size_t tile, const Body& body) {
  const TileGrid grid{size};
  const int x0 = static_cast<int>(tile % grid.columns()) * tile_size;
  const int y0 = static_cast<int>(tile / grid.columns()) * tile_size;
  for (int y = y0; y < std::min(y0 + tile_size, size.height); ++y)
    for (int x = x0; x < std::min(x0 + tile_size, size.width); ++x)
      body(x, y,
           static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x));
}

template <class Sample>
std::uint64_t sample_tile(PictureState& state, std::size_t tile, const Sample& sample) {
  std::uint64_t faults = 0;
  for_each_pixel(state.size, tile, [&](int x, int y, std::size_t pixel) {
    faults += sample_pixel(state, x, y, pixel, sample);
  });
  return faults;
}

inline PictureProgress progress_of(const PictureState& state, const PictureOptions& options) {
  PictureProgress progress;
  for (const std::uint32_t count : state.count) progress.samples += count;
  const double most = static_cast<double>(options.samples) * static_cast<double>(state.count.size());
  progress.share = static_cast<double>(progress.samples) / most;
  return progress;
}

inline bool is_open(const PictureState& state, std::size_t tile) {
  bool open = false;
  for_each_pixel(state.size, tile,
                 [&](int, int, std::size_t pixel) { open |= state.count[pixel] < state.goal[pixel]; });
  return open;
}

inline std::vector<std::size_t> open_tiles(const PictureState& state) {
  std::vector<std::size_t> tiles;
  for (std::size_t tile = 0; tile < TileGrid{state.size}.count(); ++tile)
    if (is_open(state, tile)) tiles.push_back(tile);
  return tiles;
}

enum class RoundEnd { finished, finished_and_stopped, stopped };

/// Tiles of the round under way, in groups that take about a quarter of a second.
template <class Sample>
RoundEnd finish_round(PictureState& state, const PictureOptions& options, const Sample& sample,
                      const PictureObserver& observer) {
  using clock = std::chrono::steady_clock;
  const std::vector<std::size_t> tiles = open_tiles(state);
  std::size_t group = 64;
  for (std::size_t first = 0; first < tiles.size();) {
    const auto start = clock::now();
    const std::size_t here = std::min(group, tiles.size() - first);
    const auto faults = parallel_partials<std::uint64_t>(
        here, 1, [&](std::uint64_t& partial, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) partial += sample_tile(state, tiles[first + i], sample);
        });
    for (const std::uint64_t count : faults) state.faults += count;
    first += here;
    if (observer && !observer(progress_of(state, options)))
      return first < tiles.size() ? RoundEnd::stopped : RoundEnd::finished_and_stopped;
    const double seconds = std::chrono::duration<double>(clock::now() - start).count();
    if (seconds < 0.12) group *= 2;
    if (seconds > 0.5) group = std::max<std::size_t>(8, group / 2);
  }
  return RoundEnd::finished;
}

}  // namespace welkin::picture_loop

namespace welkin {

template <class Sample>
bool sample_picture(PictureState& state, const PictureOptions& options, const Sample& sample,
                    const PictureObserver& observer) {
  using picture_loop::RoundEnd;
  while (true) {
    const RoundEnd end = picture_loop::finish_round(state, options, sample, observer);
    if (end == RoundEnd::stopped) return false;
    if (!plan_round(state, options)) return true;
    if (end == RoundEnd::finished_and_stopped) return false;
  }
}

}  // namespace welkin
