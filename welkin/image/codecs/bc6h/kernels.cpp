#include <welkin/image/codecs/bc6h/kernels.h>

#include <cmath>

#include <welkin/parallel/target_clones.h>

namespace welkin::bc6h {
namespace {

constexpr std::array<int, 16> weights_of_8 = {0, 9, 18, 27, 37, 46, 55, 64, 64, 64, 64, 64, 64, 64, 64, 64};
constexpr std::array<int, 16> ones = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
constexpr float out_of_reach = 3.2e7f;  // on the error scale: its square is `forbidden`
constexpr float unit_floor = 1e-30f;    // keeps divisions by sums of weights finite

// One channel of the palette on the error scale; `out_of_reach` where a magnitude exceeds limit. The interpolation is
// first + weight (second - first) in the specification's words.
template <int levels>
WELKIN_INLINE void palette_levels(const float* scale, int first, int second, int limit, bool is_signed,
                                  float out[16]) {
  const IntLanes weights = load(levels == 8 ? weights_of_8.data() : weights4.data());
  const IntLanes position = (weights * (second - first) + broadcast(64 * first + 32)) >> 6;
  const IntLanes half = (magnitude(position) * 31) >> (is_signed ? 5 : 6);
  int halves[16], positions[16];
  store(half, halves), store(position, positions);
  for (int k = 0; k < levels; ++k) {
    const float level = halves[k] > limit ? out_of_reach : scale[halves[k]];
    out[k] = positions[k] < 0 ? -level : level;
  }
}

template <int levels>
WELKIN_INLINE float assign_among(const Targets& targets, const Lanes& member, const Ends& ends,
                                 IntLanes& indices) {
  float palette[3][16];
  for (std::size_t c = 0; c < 3; ++c) {
    palette_levels<levels>(targets.scale, ends.first[c], ends.second[c], targets.limit[c], targets.is_signed,
                           palette[c]);
  }
  const Lanes red = targets.level[0], green = targets.level[1], blue = targets.level[2];
  Lanes best = broadcast(1e30f);
  IntLanes chosen, current;
  const IntLanes one = load(ones.data());
  for (int k = 0; k < levels; ++k) {
    const Lanes r = red - palette[0][k], g = green - palette[1][k], b = blue - palette[2][k];
    const Lanes distance = r * r + g * g + b * b;
    const IntLanes closer = distance < best;
    best = select(closer, distance, best);
    chosen = select(closer, current, chosen);
    current = current + one;
  }
  indices = chosen;
  return sum(best * member * targets.importance);
}

struct Moments {
  Lanes n{}, x{}, y{}, z{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};

// trace - (1 - share) * the largest eigenvalue of the scatter matrix, per lane. Power iteration from the row of the
// largest diagonal entry.
WELKIN_INLINE Lanes residual(const Moments& m, float share) {
  const Lanes inverse = broadcast(1.0f) / (m.n + unit_floor);
  const Lanes xx = m.xx - m.x * m.x * inverse, yy = m.yy - m.y * m.y * inverse,
              zz = m.zz - m.z * m.z * inverse;
  const Lanes xy = m.xy - m.x * m.y * inverse, xz = m.xz - m.x * m.z * inverse,
              yz = m.yz - m.y * m.z * inverse;
  const IntLanes y_over_x = xx < yy, z_largest = maximum(xx, yy) < zz;
  Lanes u = select(z_largest, xz, select(y_over_x, xy, xx));
  Lanes v = select(z_largest, yz, select(y_over_x, yy, xy));
  Lanes w = select(z_largest, zz, select(y_over_x, yz, xz));
  Lanes top;
  for (int round = 0; round < 3; ++round) {
    const Lanes largest = maximum(maximum(magnitude(u), magnitude(v)), magnitude(w));
    const Lanes scale = broadcast(1.0f) / (largest + unit_floor);
    u = u * scale, v = v * scale, w = w * scale;
    const Lanes a = xx * u + xy * v + xz * w, b = xy * u + yy * v + yz * w, c = xz * u + yz * v + zz * w;
    top = (a * u + b * v + c * w) / (u * u + v * v + w * w + unit_floor);
    u = a, v = b, w = c;
  }
  return maximum(xx + yy + zz - top * (1 - share), Lanes{});
}

struct Membership {
  std::array<std::array<Lanes, 2>, partition_count> of_subset;
  std::array<std::array<Lanes, 2>, 16> second_by_texel;  // [texel][partition / 16], lane partition % 16
};

Membership make_membership() {
  float second[partition_count][16] = {}, first[partition_count][16] = {}, by_texel[16][partition_count] = {};
  for (int p = 0; p < partition_count; ++p) {
    for (int t = 0; t < texel_count; ++t) {
      const int bit = (partitions[static_cast<std::size_t>(p)] >> t) & 1;
      second[p][t] = by_texel[t][p] = static_cast<float>(bit);
      first[p][t] = static_cast<float>(1 - bit);
    }
  }
  Membership result{};
  for (std::size_t p = 0; p < partition_count; ++p) result.of_subset[p] = {load(first[p]), load(second[p])};
  for (std::size_t t = 0; t < 16; ++t)
    result.second_by_texel[t] = {load(by_texel[t]), load(by_texel[t] + 16)};
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

WELKIN_INLINE Scaled scaled_positions(const Targets& targets, const Lanes& member) {
  Scaled s{};
  const Lanes mean = (targets.weight[0] + targets.weight[1] + targets.weight[2]) * member;
  const float total = sum(mean) + unit_floor;
  s.weight = mean * (1 / total);
  for (std::size_t c = 0; c < 3; ++c) {
    s.unit[c] = std::sqrt(sum(targets.weight[c] * member)) + unit_floor;
    s.value[c] = targets.position[c] * s.unit[c];
  }
  return s;
}

WELKIN_INLINE std::array<float, 3> principal_axis(const std::array<Lanes, 3>& d, const Lanes& weight) {
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
  static const Lanes all = broadcast(1.0f);
  return all;
}

WELKIN_TARGET_CLONES float assign(const Targets& targets, const Lanes& member, const Ends& ends, int levels,
                                  IntLanes& indices) {
  return levels == 8 ? assign_among<8>(targets, member, ends, indices)
                     : assign_among<16>(targets, member, ends, indices);
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
  const float low = smallest(along), high = -smallest(Lanes{} - along);
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
  int index[16];
  float share[16];
  store(indices, index);
  for (int t = 0; t < 16; ++t) {
    share[t] = static_cast<float>(weights[static_cast<std::size_t>(index[t])]) * (1.0f / 64);
  }
  const Lanes second = load(share), first = broadcast(1.0f) - second;
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
  float term[10][16];
  for (std::size_t q = 0; q < 10; ++q) {
    total[q] = broadcast(sum(terms[q]));
    store(terms[q], term[q]);
  }
  const Membership& table = membership();
  for (std::size_t half = 0; half < 2; ++half) {
    std::array<Lanes, 10> in_second, in_first;
    for (std::size_t q = 0; q < 10; ++q) {
      Lanes partial;
      for (std::size_t t = 0; t < 16; ++t) partial = partial + table.second_by_texel[t][half] * term[q][t];
      in_second[q] = partial;
      in_first[q] = total[q] - partial;
    }
    constexpr float on_axis = 1.0f / 49;  // 7 steps: of a uniform spread, (1/7)^2 of the variance is left
    const Lanes both = residual(moments_of(in_first), on_axis) + residual(moments_of(in_second), on_axis);
    store(both, estimates.data() + 16 * half);
  }
  return residual(moments_of(total), 1.0f / 225)[0];
}

IndexStatistics index_statistics(const Lanes& level, const Lanes& member, const IntLanes& indices) {
  float values[16], weights[16], count[16] = {}, total[16] = {};
  int index[16];
  store(level, values), store(member, weights), store(indices, index);
  for (int t = 0; t < 16; ++t) {
    count[index[t]] += weights[t];
    total[index[t]] += weights[t] * values[t];
  }
  return {load(count), load(total) / (load(count) + unit_floor)};
}

WELKIN_TARGET_CLONES float channel_cost(const float* scale, const IndexStatistics& statistics, int first,
                                        int second, int levels, int limit, bool is_signed) {
  float palette[16] = {};
  if (levels == 8) {
    palette_levels<8>(scale, first, second, limit, is_signed, palette);
  } else {
    palette_levels<16>(scale, first, second, limit, is_signed, palette);
  }
  const Lanes d = load(palette) - statistics.mean;
  return sum(statistics.count * d * d);
}

}  // namespace welkin::bc6h
