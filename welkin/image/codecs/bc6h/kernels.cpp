#include <welkin/image/codecs/bc6h/kernels.h>

#include <cmath>

#include <welkin/image/codecs/bc6h/error_scale.h>
#include <welkin/parallel/target_clones.h>

namespace welkin::bc6h {
namespace {

constexpr std::array<int, 16> weights_of_8 = {0, 9, 18, 27, 37, 46, 55, 64, 64, 64, 64, 64, 64, 64, 64, 64};
constexpr float unit_floor = 1e-30f;  // keeps divisions by sums of weights finite

[[gnu::always_inline]] inline IntLanes weight_lanes(int levels) {
  IntLanes lanes{};
  const std::array<int, 16>& weights = levels == 8 ? weights_of_8 : weights4;
  for (int k = 0; k < 16; ++k) lanes[k] = weights[static_cast<std::size_t>(k)];
  return lanes;
}

// One channel of the palette as halves, sign and magnitude.
[[gnu::always_inline]] inline IntLanes palette_halves(int first, int second, const IntLanes& weights,
                                                      bool is_signed) {
  const IntLanes position = ((64 - weights) * first + weights * second + 32) >> 6;
  const IntLanes magnitude = ((position < 0 ? -position : position) * 31) >> (is_signed ? 5 : 6);
  return position < 0 ? -magnitude : magnitude;
}

// Levels of the palette; `forbidden` levels (so far that squaring gives `forbidden`) where a magnitude exceeds limit.
[[gnu::always_inline]] inline Lanes palette_levels(const IntLanes& halves, int limit) {
  const float* scale = error_scale();
  Lanes levels{};
  for (int k = 0; k < 16; ++k) levels[k] = scale[halves[k]];
  const IntLanes above = (halves > limit) | (halves < -limit);
  return above ? broadcast(3.2e7f) : levels;
}

struct Moments {
  Lanes n{}, x{}, y{}, z{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};

// trace - (1 - share) * the largest eigenvalue of the scatter matrix, per lane. Power iteration from the row of the
// largest diagonal entry.
[[gnu::always_inline]] inline Lanes residual(const Moments& m, float share) {
  const Lanes inverse = 1.0f / (m.n + unit_floor);
  const Lanes xx = m.xx - m.x * m.x * inverse, yy = m.yy - m.y * m.y * inverse,
              zz = m.zz - m.z * m.z * inverse;
  const Lanes xy = m.xy - m.x * m.y * inverse, xz = m.xz - m.x * m.z * inverse,
              yz = m.yz - m.y * m.z * inverse;
  const IntLanes x_largest = (xx >= yy) & (xx >= zz), y_largest = (yy >= zz) & ~x_largest;
  Lanes u = x_largest ? xx : (y_largest ? xy : xz);
  Lanes v = x_largest ? xy : (y_largest ? yy : yz);
  Lanes w = x_largest ? xz : (y_largest ? yz : zz);
  Lanes top{};
  for (int round = 0; round < 3; ++round) {
    const Lanes largest = maximum(maximum(u < 0 ? -u : u, v < 0 ? -v : v), w < 0 ? -w : w);
    const Lanes scale = 1.0f / (largest + unit_floor);
    u *= scale, v *= scale, w *= scale;
    const Lanes a = xx * u + xy * v + xz * w, b = xy * u + yy * v + yz * w, c = xz * u + yz * v + zz * w;
    top = (a * u + b * v + c * w) / (u * u + v * v + w * w + unit_floor);
    u = a, v = b, w = c;
  }
  return maximum(xx + yy + zz - (1 - share) * top, Lanes{});
}

struct Membership {
  std::array<std::array<Lanes, 2>, partition_count> of_subset;
  std::array<std::array<Lanes, 2>, 16> second_by_texel;  // [texel][partition / 16], lane partition % 16
};

Membership make_membership() {
  Membership result{};
  for (int p = 0; p < partition_count; ++p) {
    for (int t = 0; t < texel_count; ++t) {
      const int second = (partitions[static_cast<std::size_t>(p)] >> t) & 1;
      result.of_subset[static_cast<std::size_t>(p)][0][t] = static_cast<float>(1 - second);
      result.of_subset[static_cast<std::size_t>(p)][1][t] = static_cast<float>(second);
      result.second_by_texel[static_cast<std::size_t>(t)][static_cast<std::size_t>(p / 16)][p % 16] =
          static_cast<float>(second);
    }
  }
  return result;
}

const Membership& membership() {
  static const Membership table = make_membership();
  return table;
}

// Positions made comparable between channels: times the root of the channel's mean weight.
struct Scaled {
  std::array<Lanes, 3> value;
  std::array<float, 3> unit;
  Lanes weight;
};

[[gnu::always_inline]] inline Scaled scaled_positions(const Targets& targets, const Lanes& member) {
  Scaled s{};
  const Lanes mean = (targets.weight[0] + targets.weight[1] + targets.weight[2]) * member;
  const float total = sum(mean) + unit_floor;
  s.weight = mean / total;
  for (std::size_t c = 0; c < 3; ++c) {
    s.unit[c] = std::sqrt(sum(targets.weight[c] * member)) + unit_floor;
    s.value[c] = targets.position[c] * s.unit[c];
  }
  return s;
}

[[gnu::always_inline]] inline std::array<float, 3> principal_axis(const std::array<Lanes, 3>& d,
                                                                  const Lanes& weight) {
  const float xx = sum(d[0] * d[0] * weight), yy = sum(d[1] * d[1] * weight), zz = sum(d[2] * d[2] * weight);
  const float xy = sum(d[0] * d[1] * weight), xz = sum(d[0] * d[2] * weight), yz = sum(d[1] * d[2] * weight);
  float u = xx, v = xy, w = xz;
  if (yy > xx && yy >= zz) u = xy, v = yy, w = yz;
  if (zz > xx && zz > yy) u = xz, v = yz, w = zz;
  for (int round = 0; round < 4; ++round) {
    const float inverse = 1 / (std::sqrt(u * u + v * v + w * w) + unit_floor);
    u *= inverse, v *= inverse, w *= inverse;
    const float a = xx * u + xy * v + xz * w, b = xy * u + yy * v + yz * w, c = xz * u + yz * v + zz * w;
    u = a, v = b, w = c;
  }
  const float inverse = 1 / (std::sqrt(u * u + v * v + w * w) + unit_floor);
  return {u * inverse, v * inverse, w * inverse};
}

}  // namespace

const Lanes& member_of(int partition, int subset) {
  return membership().of_subset[static_cast<std::size_t>(partition)][static_cast<std::size_t>(subset)];
}

const Lanes& all_members() {
  static const Lanes ones = broadcast(1);
  return ones;
}

WELKIN_TARGET_CLONES float assign(const Targets& targets, const Lanes& member, const Ends& ends, int levels,
                                  IntLanes& indices) {
  const IntLanes weights = weight_lanes(levels);
  std::array<Lanes, 3> palette;
  for (std::size_t c = 0; c < 3; ++c) {
    palette[c] = palette_levels(palette_halves(ends.first[c], ends.second[c], weights, targets.is_signed),
                                targets.limit[c]);
  }
  const Lanes red = targets.level[0], green = targets.level[1], blue = targets.level[2];
  Lanes best = broadcast(1e30f);
  IntLanes chosen{};
  for (int k = 0; k < levels; ++k) {
    const Lanes r = red - palette[0][k], g = green - palette[1][k], b = blue - palette[2][k];
    const Lanes distance = r * r + g * g + b * b;
    const IntLanes closer = distance < best;
    best = closer ? distance : best;
    chosen = closer ? IntLanes{} + k : chosen;
  }
  indices = chosen;
  return sum(best * member * targets.importance);
}

WELKIN_TARGET_CLONES Line principal_line(const Targets& targets, const Lanes& member) {
  const Scaled s = scaled_positions(targets, member);
  std::array<float, 3> mean{};
  std::array<Lanes, 3> d;
  for (std::size_t c = 0; c < 3; ++c) {
    mean[c] = sum(s.value[c] * s.weight);
    d[c] = s.value[c] - mean[c];
  }
  const std::array<float, 3> axis = principal_axis(d, s.weight);
  const Lanes along = (d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) * member;  // others at 0, inside
  const float low = smallest(along), high = -smallest(-along);
  Line line;
  for (std::size_t c = 0; c < 3; ++c) {
    line.first[c] = (mean[c] + low * axis[c]) / s.unit[c];
    line.second[c] = (mean[c] + high * axis[c]) / s.unit[c];
  }
  return line;
}

WELKIN_TARGET_CLONES Line least_squares(const Targets& targets, const Lanes& member, const IntLanes& indices,
                                        int levels, const Line& fallback) {
  const std::array<int, 16>& weights = levels == 8 ? weights_of_8 : weights4;
  Lanes second{};
  for (int t = 0; t < 16; ++t) {
    second[t] = static_cast<float>(weights[static_cast<std::size_t>(indices[t])]) * (1.0f / 64);
  }
  const Lanes first = 1.0f - second;
  Line line = fallback;
  for (std::size_t c = 0; c < 3; ++c) {
    const Lanes w = targets.weight[c] * member;
    const float origin = fallback.first[c];  // near the solution, so that nothing cancels
    const Lanes d = targets.position[c] - origin;
    const float aa = sum(w * first * first), ab = sum(w * first * second), bb = sum(w * second * second);
    const float ad = sum(w * first * d), bd = sum(w * second * d);
    const float determinant = aa * bb - ab * ab;
    if (determinant <= 1e-4f * (aa + bb) * (aa + bb)) continue;
    line.first[c] = origin + (ad * bb - bd * ab) / determinant;
    line.second[c] = origin + (bd * aa - ad * ab) / determinant;
  }
  return line;
}

WELKIN_TARGET_CLONES float rank_partitions(const Targets& targets,
                                           std::array<float, partition_count>& estimates) {
  const Scaled s = scaled_positions(targets, all_members());
  std::array<Lanes, 3> d;
  for (std::size_t c = 0; c < 3; ++c) d[c] = s.value[c] - sum(s.value[c] * s.weight);
  const std::array<Lanes, 10> terms = {s.weight,
                                       s.weight * d[0],
                                       s.weight * d[1],
                                       s.weight * d[2],
                                       s.weight * d[0] * d[0],
                                       s.weight * d[1] * d[1],
                                       s.weight * d[2] * d[2],
                                       s.weight * d[0] * d[1],
                                       s.weight * d[0] * d[2],
                                       s.weight * d[1] * d[2]};
  const auto moments_of = [](const std::array<Lanes, 10>& v) {
    return Moments{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9]};
  };
  std::array<Lanes, 10> total;
  for (std::size_t q = 0; q < 10; ++q) total[q] = broadcast(sum(terms[q]));
  const Membership& table = membership();
  for (std::size_t half = 0; half < 2; ++half) {
    std::array<Lanes, 10> in_second{}, in_first;
    for (int t = 0; t < 16; ++t) {
      const Lanes& second = table.second_by_texel[static_cast<std::size_t>(t)][half];
      for (std::size_t q = 0; q < 10; ++q) in_second[q] += second * terms[q][t];
    }
    for (std::size_t q = 0; q < 10; ++q) in_first[q] = total[q] - in_second[q];
    constexpr float on_axis = 1.0f / 49;  // 7 steps: of a uniform spread, (1/7)^2 of the variance is left
    const Lanes both = residual(moments_of(in_first), on_axis) + residual(moments_of(in_second), on_axis);
    for (int p = 0; p < 16; ++p) estimates[16 * half + static_cast<std::size_t>(p)] = both[p];
  }
  return residual(moments_of(total), 1.0f / 225)[0];
}

IndexStatistics index_statistics(const Lanes& level, const Lanes& member, const IntLanes& indices) {
  IndexStatistics result{};
  for (int t = 0; t < 16; ++t) {
    result.count[indices[t]] += member[t];
    result.mean[indices[t]] += member[t] * level[t];
  }
  result.mean /= result.count + unit_floor;
  return result;
}

WELKIN_TARGET_CLONES float channel_cost(const IndexStatistics& statistics, int first, int second, int levels,
                                        int limit, bool is_signed) {
  const Lanes palette = palette_levels(palette_halves(first, second, weight_lanes(levels), is_signed), limit);
  const Lanes d = palette - statistics.mean;
  return sum(statistics.count * d * d);
}

}  // namespace welkin::bc6h
