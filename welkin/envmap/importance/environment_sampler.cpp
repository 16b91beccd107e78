#include <welkin/envmap/importance/environment_sampler.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/envmap/importance/alias_table.h>
#include <welkin/envmap/importance/direction_lanes.h>
#include <welkin/envmap/importance/inverse_table.h>
#include <welkin/envmap/importance/quad_table.h>
#include <welkin/error.h>
#include <welkin/geometry/fast_angles.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/prefetch.h>
#include <welkin/sphere/equirect.h>

// Positions. A map position is s = u, t = v of docs/conventions.md; within a texel of the box model samples are uniform
// per steradian (luminance_solid_angle) or per ds dt (luminance). From (s, t) to solid angle: theta = pi t, phi = 2 pi s -
// pi, so d omega = sin theta d theta d phi = 2 pi^2 sin theta ds dt, and pdf per steradian = p(s, t) / (2 pi^2 sin theta).
//
// Uniform per steradian means linear in cos theta. Near a pole cos theta has no digits left in a float, so it is kept as
// h = sin^2(theta / 2), of the angle to the nearer pole: cos theta = 1 - 2 h, sin theta = 2 sqrt(h (1 - h)), and h is as
// linear as cos theta is.
//
// A direction made from a position is rounded, and looked up again it must lie in the same texel: positions are kept a
// few units of that rounding away from the texel's edges.

namespace welkin {
namespace {

constexpr float darkest = 1e-25f;
constexpr float smallest_sine = 1e-9f;

using MapPosition = EnvironmentPlace;

struct RowShape {
  float h = 0, h_step = 0;  // at the row's upper edge, and to its lower edge
  float pole = 1;           // +1: h is about the upper pole
  float per_steradian = 0;  // 1 / (solid angle of a texel)
};

std::vector<RowShape> row_shapes(int width, int height) {
  std::vector<RowShape> rows(height);
  for (int y = 0; y < height; ++y) {
    const bool upper = 2 * y < height;
    const auto h_of = [&](int edge) {
      const double half = std::numbers::pi / 2 * (upper ? edge : height - edge) / height;
      return std::sin(half) * std::sin(half);
    };
    rows[y] = {static_cast<float>(h_of(y)), static_cast<float>(h_of(y + 1) - h_of(y)), upper ? 1.0f : -1.0f,
               static_cast<float>(1 / equirect_texel_solid_angle(width, height, y))};
  }
  return rows;
}

// The tent about a texel's centre, -1 to 1, by inverting its CDF.
float tent_offset(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

float clamped_unit(float v, float margin) { return margin + (1 - 2 * margin) * std::min(v, 1.0f); }

}  // namespace

void check_sampled_map(const Image& map, const EnvironmentSamplerOptions& options) {
  if (map.empty() || map.channels != 3)
    throw Error("an environment to sample needs 3 channels and at least one texel");
  if (map.width > 65536 || map.height > 65536)
    throw Error(fmt::format("a map of {} x {} is too large to sample: at most 65536 each way", map.width,
                            map.height));
  for (float weight : options.luminance_weights)
    if (!(weight >= 1e-3f && weight <= 1e3f)) throw Error("luminance weights are in [0.001, 1000]");
  for (float value : map.pixels)
    if (!(value >= 0 && value <= 3.4e38f))
      throw Error("an environment to sample has a value that is negative or not finite");
}

struct EnvironmentSampler::Tables {
  Tables(Image&& radiance, const EnvironmentSamplerOptions& chosen);

  TexelChoice choose(Vec2f u) const {
    switch (options.table) {
      case EnvironmentTable::alias: return alias.choose(u);
      case EnvironmentTable::hierarchical: return quad.choose(u);
      default: return inverse.choose(u);
    }
  }
  float probability(int x, int y) const {
    switch (options.table) {
      case EnvironmentTable::alias: return alias.probability(x, y);
      case EnvironmentTable::hierarchical: return quad.probability(x, y);
      default: return inverse.probability(x, y);
    }
  }
  void choose(std::span<const Vec2f> u, TexelChoice* choices) const {
    if (options.table == EnvironmentTable::inverse) return inverse.choose(u, choices);
    if (options.table == EnvironmentTable::hierarchical) return quad.choose(u, choices);
    for (std::size_t i = 0; i < u.size(); ++i) choices[i] = choose(u[i]);
  }
  void prefetch_texel(int x, int y) const {
    prefetch(map.at(x, y));
    if (options.table == EnvironmentTable::inverse) inverse.prefetch_probability(x, y);
  }
  EnvironmentSample sample(const TexelChoice& choice) const {
    return bilinear() ? sample_bilinear(choice) : sample_box(choice);
  }
  // Those of the tables that are not in use are empty.
  std::size_t bytes() const { return inverse.bytes() + alias.bytes() + quad.bytes(); }

  int column_of(float s) const { return std::min(static_cast<int>(s * wide), map.width - 1); }
  int row_of(float t) const { return std::min(static_cast<int>(t * high), map.height - 1); }
  Rgb texel(int x, int y) const {
    const float* p = map.at(x, y);
    return {p[0], p[1], p[2]};
  }
  // From the probability of a texel to steradians, where texels are sampled evenly in (s, t).
  float map_density(float sine) const {
    constexpr float jacobian = static_cast<float>(2 * std::numbers::pi * std::numbers::pi);
    return texels / (jacobian * std::max(sine, smallest_sine));
  }
  // From the left edge, in turns; and h within a row.
  float turns_of(int x, Vec2f within) const {
    return (static_cast<float>(x) + clamped_unit(within.x, margin)) / wide;
  }
  float height_of(const RowShape& row, Vec2f within) const {
    return row.h + clamped_unit(within.y, margin) * row.h_step;
  }
  Vec3f solid_angle_direction(int x, int y, Vec2f within) const;
  void sample_boxes(std::span<const TexelChoice> choices, EnvironmentSample* samples) const;
  EnvironmentSample sample_box(const TexelChoice& choice) const;
  EnvironmentSample sample_bilinear(const TexelChoice& choice) const;
  EnvironmentSample at_box(const MapPosition& position) const;
  EnvironmentSample at_bilinear(const MapPosition& position) const;
  bool bilinear() const { return options.interpolation == EnvironmentInterpolation::bilinear; }

  Image map;
  EnvironmentSamplerOptions options;
  std::vector<RowShape> rows;
  float wide = 0, high = 0, texels = 0;
  float margin = 0;  // of a texel
  bool black = true;
  double mean = 0;
  InverseTable inverse;
  AliasTable alias;
  QuadTable quad;
};

EnvironmentSampler::Tables::Tables(Image&& radiance, const EnvironmentSamplerOptions& chosen)
    : map(std::move(radiance)), options(chosen), rows(row_shapes(map.width, map.height)) {
  for (float& value : map.pixels) value = value < darkest ? 0 : value;
  wide = static_cast<float>(map.width);
  high = static_cast<float>(map.height);
  texels = wide * high;
  margin = std::max(0x1p-12f, 0x1p-22f * std::max(wide, 2 * high));
  TexelWeights weights{map, options.luminance_weights, std::vector<double>(map.height, 1.0)};
  std::vector<double> sums(map.height);
  parallel_for(map.height, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const int row = static_cast<int>(y);
      for (int x = 0; x < map.width; ++x) sums[y] += luminance(texel(x, row));
      const double solid_angle = equirect_texel_solid_angle(map.width, map.height, row);
      sums[y] *= solid_angle;
      if (options.density == EnvironmentDensity::luminance_solid_angle) weights.row_factor[y] = solid_angle;
    }
  });
  for (double sum : sums) mean += sum / (4 * std::numbers::pi);
  black = std::all_of(map.pixels.begin(), map.pixels.end(), [](float value) { return value == 0; });
  switch (options.table) {
    case EnvironmentTable::alias: alias = AliasTable(weights); break;
    case EnvironmentTable::hierarchical: quad = QuadTable(weights); break;
    default: inverse = InverseTable(weights);
  }
}

Vec3f EnvironmentSampler::Tables::solid_angle_direction(int x, int y, Vec2f within) const {
  const RowShape& row = rows[y];
  return direction_by_height(turns_of(x, within), height_of(row, within), row.pole);
}

void EnvironmentSampler::Tables::sample_boxes(std::span<const TexelChoice> choices,
                                              EnvironmentSample* samples) const {
  HeightLanes lanes;
  assert(choices.size() <= direction_lanes);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const TexelChoice& choice = choices[i];
    const RowShape& row = rows[choice.y];
    lanes.turns[i] = turns_of(choice.x, choice.within);
    lanes.h[i] = height_of(row, choice.within);
    lanes.pole[i] = row.pole;
  }
  directions_by_height(lanes);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const TexelChoice& choice = choices[i];
    samples[i] = {{lanes.x[i], lanes.y[i], lanes.z[i]},
                  texel(choice.x, choice.y),
                  choice.probability * rows[choice.y].per_steradian};
  }
}

EnvironmentSample EnvironmentSampler::Tables::sample_box(const TexelChoice& choice) const {
  const Rgb found = texel(choice.x, choice.y);
  if (options.density == EnvironmentDensity::luminance_solid_angle)
    return {solid_angle_direction(choice.x, choice.y, choice.within), found,
            choice.probability * rows[choice.y].per_steradian};
  const float s = (static_cast<float>(choice.x) + clamped_unit(choice.within.x, margin)) / wide;
  const float down = clamped_unit(choice.within.y, margin);
  const Vec2f around = cos_sin_turns(s - 0.5f);
  const Vec2f theta = cos_sin_turns((static_cast<float>(choice.y) + down) / high * 0.5f);
  return {
      {theta.y * around.x, theta.x, theta.y * around.y}, found, choice.probability * map_density(theta.y)};
}

// The density of the tents about all texels, each with its texel's probability: the bilinear interpolation of the
// probabilities. Beyond the first and the last row's centres those rows go on to the poles, as radiance does.
EnvironmentSample EnvironmentSampler::Tables::sample_bilinear(const TexelChoice& choice) const {
  const float ux = clamped_unit(choice.within.x, margin), uy = clamped_unit(choice.within.y, margin);
  float s = (static_cast<float>(choice.x) + 0.5f + (1 - margin) * tent_offset(ux)) / wide;
  s -= std::floor(s);
  float down = 0.5f + (1 - margin) * tent_offset(uy);
  if ((choice.y == 0 && uy < 0.5f) || (choice.y + 1 == map.height && uy >= 0.5f)) down = uy;
  const float t = (static_cast<float>(choice.y) + down) / high;
  const Vec2f around = cos_sin_turns(s - 0.5f), theta = cos_sin_turns(0.5f * t);
  EnvironmentSample sample = at_bilinear({s, t, theta.y});
  sample.direction = {theta.y * around.x, theta.x, theta.y * around.y};
  return sample;
}

EnvironmentSample EnvironmentSampler::Tables::at_box(const MapPosition& position) const {
  const int x = column_of(position.s), y = row_of(position.t);
  const float chance = probability(x, y);
  const bool by_angle = options.density == EnvironmentDensity::luminance_solid_angle;
  return {{}, texel(x, y), by_angle ? chance * rows[y].per_steradian : chance * map_density(position.sine)};
}

EnvironmentSample EnvironmentSampler::Tables::at_bilinear(const MapPosition& position) const {
  const float across = position.s * wide - 0.5f, down = position.t * high - 0.5f;
  const float left = std::floor(across), top = std::floor(down);
  const float fx = across - left, fy = down - top;
  const int columns = map.width, last = map.height - 1;
  const int x0 = (static_cast<int>(left) + columns) % columns, x1 = x0 + 1 < columns ? x0 + 1 : 0;
  const int y0 = std::clamp(static_cast<int>(top), 0, last), y1 = std::min(static_cast<int>(top) + 1, last);
  const float w00 = (1 - fx) * (1 - fy), w10 = fx * (1 - fy), w01 = (1 - fx) * fy, w11 = fx * fy;
  EnvironmentSample result;
  result.radiance = w00 * texel(x0, y0) + w10 * texel(x1, y0) + (w01 * texel(x0, y1) + w11 * texel(x1, y1));
  const float chance = w00 * probability(x0, y0) + w10 * probability(x1, y0) + w01 * probability(x0, y1) +
                       w11 * probability(x1, y1);
  result.pdf = chance * map_density(position.sine);
  return result;
}

EnvironmentSampler::EnvironmentSampler(Image radiance, const EnvironmentSamplerOptions& options) {
  check_sampled_map(radiance, options);
  tables_ = std::make_unique<Tables>(std::move(radiance), options);
}
EnvironmentSampler::~EnvironmentSampler() = default;
EnvironmentSampler::EnvironmentSampler(EnvironmentSampler&&) noexcept = default;
EnvironmentSampler& EnvironmentSampler::operator=(EnvironmentSampler&&) noexcept = default;

EnvironmentSample EnvironmentSampler::sample(Vec2f u) const {
  if (tables_->black) return {{0, 1, 0}, {}, 0};
  return tables_->sample(tables_->choose(u));
}

void EnvironmentSampler::sample(std::span<const Vec2f> u, std::span<EnvironmentSample> samples) const {
  assert(samples.size() == u.size());
  constexpr std::size_t batch = direction_lanes;
  std::array<TexelChoice, batch> choices;
  for (std::size_t begin = 0; begin < u.size(); begin += batch) {
    const std::size_t count = std::min(batch, u.size() - begin);
    if (tables_->black) {
      for (std::size_t i = 0; i < count; ++i) samples[begin + i] = {{0, 1, 0}, {}, 0};
      continue;
    }
    tables_->choose(u.subspan(begin, count), choices.data());
    for (std::size_t i = 0; i < count; ++i) prefetch(tables_->map.at(choices[i].x, choices[i].y));
    if (!tables_->bilinear() && tables_->options.density == EnvironmentDensity::luminance_solid_angle) {
      tables_->sample_boxes({choices.data(), count}, &samples[begin]);
    } else {
      for (std::size_t i = 0; i < count; ++i) samples[begin + i] = tables_->sample(choices[i]);
    }
  }
}

EnvironmentSample EnvironmentSampler::at(Vec3f direction) const {
  return at(direction, place_in_map(direction));
}

void EnvironmentSampler::places(std::span<const Vec3f> directions, std::span<EnvironmentPlace> found) const {
  assert(found.size() == directions.size());
  for (std::size_t begin = 0; begin < directions.size(); begin += direction_lanes) {
    const std::size_t count = std::min(direction_lanes, directions.size() - begin);
    PlaceLanes lanes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f& d = directions[begin + i];
      lanes.x[i] = d.x, lanes.y[i] = d.y, lanes.z[i] = d.z;
    }
    places_in_map(lanes);
    for (std::size_t i = 0; i < count; ++i) {
      found[begin + i] = {lanes.s[i], lanes.t[i], lanes.sine[i]};
      tables_->prefetch_texel(tables_->column_of(lanes.s[i]), tables_->row_of(lanes.t[i]));
    }
  }
}

EnvironmentSample EnvironmentSampler::at(Vec3f direction, const EnvironmentPlace& place) const {
  EnvironmentSample found = tables_->bilinear() ? tables_->at_bilinear(place) : tables_->at_box(place);
  found.direction = direction;
  return found;
}

float EnvironmentSampler::pdf(Vec3f direction) const { return at(direction).pdf; }
Rgb EnvironmentSampler::radiance(Vec3f direction) const { return at(direction).radiance; }

Vec2f EnvironmentSampler::inverse(Vec3f direction) const {
  const Tables& tables = *tables_;
  if (tables.bilinear() || tables.options.table == EnvironmentTable::alias)
    throw Error("cannot invert samples of an alias table or an interpolated map: several numbers give each");
  const MapPosition position = place_in_map(direction);
  const int x = tables.column_of(position.s), y = tables.row_of(position.t);
  const float across = std::clamp(position.s * tables.wide - static_cast<float>(x), 0.0f, 1.0f);
  float down = position.t * tables.high - static_cast<float>(y);
  if (tables.options.density == EnvironmentDensity::luminance_solid_angle) {
    const RowShape& row = tables.rows[y];
    const float sine = position.sine, side = row.pole * direction.y;
    const float h = side > 0 ? sine * sine / (2 * (1 + side)) : 0.5f * (1 - side);
    down = (h - row.h) / row.h_step;
  }
  const Vec2f within{across, std::clamp(down, 0.0f, 1.0f)};
  return tables.options.table == EnvironmentTable::hierarchical ? tables.quad.invert(x, y, within)
                                                                : tables.inverse.invert(x, y, within);
}

const Image& EnvironmentSampler::map() const { return tables_->map; }
const EnvironmentSamplerOptions& EnvironmentSampler::options() const { return tables_->options; }

EnvironmentSampler::Texel EnvironmentSampler::texel_of(Vec3f direction) const {
  const MapPosition position = place_in_map(direction);
  return {tables_->column_of(position.s), tables_->row_of(position.t)};
}
Vec3f EnvironmentSampler::direction_in(Texel texel, Vec2f within) const {
  return tables_->solid_angle_direction(texel.x, texel.y, within);
}
float EnvironmentSampler::texels_per_steradian(int y) const { return tables_->rows[y].per_steradian; }

double EnvironmentSampler::mean_luminance() const { return tables_->mean; }
std::size_t EnvironmentSampler::table_bytes() const { return tables_->bytes(); }

}  // namespace welkin
