#include <welkin/sphere/direction_index.h>

#include <algorithm>
#include <cmath>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {

DirectionIndex::DirectionIndex(MapShape shape) {
  const std::size_t texels = static_cast<std::size_t>(shape.width) * shape.height;
  bins_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(texels) / 6) * 0.7), 1, 2048);
  std::vector<Entry> unsorted(texels);
  std::vector<std::uint32_t> bin(texels);
  parallel_for(static_cast<std::size_t>(shape.height), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * shape.width + x;
        const Vec3 d = map_texel_direction(shape, x, y);
        unsorted[i] = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                       static_cast<float>(map_texel_solid_angle(shape, x, y)), static_cast<std::uint32_t>(i)};
        bin[i] = static_cast<std::uint32_t>(bin_of(d));
      }
    }
  });
  start_.assign(std::size_t{6} * bins_ * bins_ + 1, 0);
  for (std::size_t i = 0; i < texels; ++i) start_[bin[i] + 1] += unsorted[i].solid_angle > 0 ? 1 : 0;
  for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
  entries_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < texels; ++i) {
    if (unsorted[i].solid_angle > 0) entries_[next[bin[i]]++] = unsorted[i];
  }
}

std::size_t DirectionIndex::bin_of(Vec3 direction) const {
  const CubePoint p = cube_point(direction);
  const auto cell = [&](double s) { return std::clamp(static_cast<int>((s + 1) / 2 * bins_), 0, bins_ - 1); };
  return (static_cast<std::size_t>(p.face) * bins_ + cell(p.t)) * bins_ + cell(p.s);
}

// On a face, tan turns angles into s: towards the middle of the face s changes by at most radius (1 + s^2 + t^2),
// away from it (inside the face, for radius <= 0.2) by at most 1.5 times that. Wider queries take every bin.
DirectionIndex::Range DirectionIndex::range_on_face(int face, Vec3 d, double radius) const {
  if (radius > 0.2) return {0, bins_ - 1, 0, bins_ - 1};
  const double axis[] = {d.x, -d.x, d.y, -d.y, d.z, -d.z};
  if (axis[face] < 0.3) return {0, -1, 0, -1};
  const double across[] = {-d.z, d.z, d.x, d.x, d.x, -d.x}, down[] = {-d.y, -d.y, d.z, -d.z, -d.y, -d.y};
  const double s = across[face] / axis[face], t = down[face] / axis[face];
  const double margin = 1.5 * radius * (1 + s * s + t * t);
  if (std::max(std::abs(s), std::abs(t)) - margin > 1) return {0, -1, 0, -1};
  const auto cell = [&](double v) {
    return std::clamp(static_cast<int>((std::clamp(v, -1.0, 1.0) + 1) / 2 * bins_), 0, bins_ - 1);
  };
  return {cell(s - margin), cell(s + margin), cell(t - margin), cell(t + margin)};
}

}  // namespace welkin
