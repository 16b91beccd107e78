#include <welkin/realtime/occlusion/slice_occlusion.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/parallel/parallel_for.h>

// Names and order are those of the shaders (occlusion_layer.glsl, occlusion_slices.glsl), which derive the formulas.

namespace welkin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

struct Pixel {
  int x, y;
  Vec3f position, normal, view;
  Vec2f noise;
};

struct Slice {
  Vec2f screen;
  Vec3f tangent, view;
  float projected, angle, cosine, sine;
};

float fraction(float x) { return x - std::floor(x); }

// To the nearest, halves to even; GLSL leaves halves to the driver.
int round_to_int(float x) { return static_cast<int>(std::lrint(x)); }

Vec2f pattern(int x, int y) {
  const int i = x & 3, j = y & 3, d = i ^ j;
  const int k = ((d & 1) << 3) | ((i & 1) << 2) | (d & 2) | ((i & 2) >> 1);
  const int reversed = ((k & 1) << 3) | ((k & 2) << 1) | ((k & 4) >> 1) | ((k & 8) >> 3);
  return {(static_cast<float>(k) + 0.5f) / 16, (static_cast<float>(reversed) + 0.5f) / 16};
}

float pixels_per_metre(const DepthLayer& layer, float depth) {
  return static_cast<float>(layer.height) / (layer.window.height * (layer.orthographic ? 1.0f : depth));
}

Pixel pixel_at(const DepthLayer& layer, int x, int y) {
  const Vec3f position = layer.point_of_pixel(x, y);
  const Vec3f view = layer.orthographic ? Vec3f{0, 0, 1} : normalized(-position);
  return {x, y, position, layer.normal[layer.index(x, y)], view, pattern(x, y)};
}

void set_angles(Slice& s, Vec3f normal) {
  const float t = dot(normal, s.tangent), v = dot(normal, s.view);
  s.projected = std::sqrt(t * t + v * v);
  s.angle = std::atan2(t, v);
  s.cosine = std::cos(s.angle);
  s.sine = std::sin(s.angle);
}

Slice slice_on_screen(float turn, const Pixel& p) {
  Slice s{};
  s.screen = {std::cos(turn), std::sin(turn)};
  s.view = p.view;
  const Vec3f flat{s.screen.x, s.screen.y, 0};
  s.tangent = normalized(flat - dot(flat, p.view) * p.view);
  set_angles(s, p.normal);
  return s;
}

Slice slice_about_view(float turn, const Pixel& p, bool orthographic) {
  Slice s{};
  const Vec3f x = normalized(Vec3f{p.view.z, 0, -p.view.x}), y = cross(p.view, x);
  s.tangent = std::cos(turn) * x + std::sin(turn) * y;
  s.view = p.view;
  Vec2f seen{s.tangent.x, s.tangent.y};
  if (!orthographic)
    seen = {-p.position.z * seen.x + p.position.x * s.tangent.z,
            -p.position.z * seen.y + p.position.y * s.tangent.z};
  const float size = std::sqrt(seen.x * seen.x + seen.y * seen.y);
  s.screen = {seen.x / size, seen.y / size};
  set_angles(s, p.normal);
  return s;
}

float slice_measure(float angle, const Slice& s) {
  const float a = std::abs(angle), side = angle < 0 ? -1.0f : 1.0f;
  return 0.25f * (s.cosine - std::cos(2 * a - side * s.angle)) + 0.5f * a * side * s.sine;
}

// The pixel of a tap; -1 where there is nothing.
int tap_index(const DepthLayer& layer, const Pixel& p, Vec2f offset) {
  const int x = p.x + round_to_int(offset.x), y = p.y + round_to_int(offset.y);
  if (x < 0 || y < 0 || x >= layer.width || y >= layer.height) return -1;
  const std::size_t index = layer.index(x, y);
  return layer.depth[index] > 0 ? static_cast<int>(index) : -1;
}

float gtao_slice(const DepthLayer& layer, const OcclusionOptions& o, const Pixel& p, const Slice& s, int i,
                 float reach) {
  const float lowest[2] = {-s.sine, s.sine};
  float horizon[2] = {lowest[0], lowest[1]};
  for (int j = 0; j < o.steps; ++j) {
    const float jitter = fraction(p.noise.y + static_cast<float>(i + j * o.slices) * 0.6180339887f);
    const float at =
        1.3f + reach * std::pow((static_cast<float>(j) + jitter) / static_cast<float>(o.steps), o.step_power);
    for (int side = 0; side < 2; ++side) {
      const float sign = side == 0 ? at : -at;
      const int tap = tap_index(layer, p, {sign * s.screen.x, sign * s.screen.y});
      if (tap < 0) continue;
      const Vec3f to = layer.point_of_pixel(tap % layer.width, tap / layer.width) - p.position;
      const float far = length(to), fade = std::max(o.falloff * o.radius_metres, 1e-6f);
      const float weight = std::clamp((o.radius_metres - far) / fade, 0.0f, 1.0f);
      const float found = lowest[side] + weight * (dot(to, p.view) / far - lowest[side]);
      horizon[side] = found > horizon[side] ? found : horizon[side] + o.thin * (found - horizon[side]);
    }
  }
  return s.projected * (slice_measure(std::acos(std::clamp(horizon[0], -1.0f, 1.0f)), s) +
                        slice_measure(-std::acos(std::clamp(horizon[1], -1.0f, 1.0f)), s));
}

float gtao_pixel(const DepthLayer& layer, const OcclusionOptions& o, const Pixel& p, float reach) {
  if (reach <= 1.3f) return 1;
  float open = 0;
  for (int i = 0; i < o.slices; ++i) {
    const float turn = pi * (static_cast<float>(i) + p.noise.x) / static_cast<float>(o.slices);
    open += gtao_slice(layer, o, p, slice_on_screen(turn, p), i, reach);
  }
  return std::clamp(open / static_cast<float>(o.slices), 0.0f, 1.0f);
}

Vec3f on_plane(const DepthLayer& layer, float x, float y, Vec3f tap, Vec3f normal, float most) {
  float depth = -tap.z;
  if (layer.orthographic) {
    const Vec3f here = layer.point(x, y, depth);
    depth += (normal.x * (here.x - tap.x) + normal.y * (here.y - tap.y)) / std::max(normal.z, 1e-3f);
  } else {
    depth = dot(normal, tap) / std::min(dot(normal, layer.point(x, y, 1)), -1e-3f);
  }
  return layer.point(x, y, std::clamp(depth, -tap.z - most, -tap.z + most));
}

// Shares of the way from a to b within the radius; first > second: none.
Vec2f within_radius(Vec2f a, Vec2f b, float radius) {
  const float dx = b.x - a.x, dy = b.y - a.y, q = std::max(dx * dx + dy * dy, 1e-20f);
  const float p = (a.x * dx + a.y * dy) / q, rest = p * p - (a.x * a.x + a.y * a.y - radius * radius) / q;
  if (rest <= 0) return {1, 0};
  const float root = std::sqrt(rest);
  return {std::clamp(-root - p, 0.0f, 1.0f), std::clamp(root - p, 0.0f, 1.0f)};
}

std::uint32_t sectors(float from, float to, float shift) {
  const int first = static_cast<int>(std::floor(from * 32 + shift));
  const int last = std::min(static_cast<int>(std::floor(to * 32 + shift)), 32);
  return last <= first ? 0u : (0xFFFFFFFFu >> (32 - last + first)) << first;
}

struct Stratum {
  float inner, at, outer;  // pixels
};

// The angles, on the side of `sign`, that the piece of surface of a tap hides; first > second: none.
Vec2f hidden_angles(const DepthLayer& layer, const OcclusionOptions& o, const Pixel& p, const Slice& s,
                    float sign, Stratum edge) {
  const Vec2f line{sign * s.screen.x, sign * s.screen.y};
  const float at = std::max(edge.at, 1.0f);
  const int tap = tap_index(layer, p, {at * line.x, at * line.y});
  if (tap < 0) return {1, 0};
  const Vec3f seen = layer.point_of_pixel(tap % layer.width, tap / layer.width);
  const Vec3f normal = layer.normal[static_cast<std::size_t>(tap)];
  const float most = 2 * (edge.outer - edge.inner + 1) / pixels_per_metre(layer, -seen.z);
  const auto in_slice = [&](float offset) {
    const Vec3f to = on_plane(layer, static_cast<float>(p.x) + 0.5f + offset * line.x,
                              static_cast<float>(p.y) + 0.5f + offset * line.y, seen, normal, most) -
                     p.position;
    return Vec2f{dot(to, s.tangent), dot(to, s.view)};
  };
  const Vec2f a = in_slice(edge.inner), b = in_slice(edge.outer), part = within_radius(a, b, o.radius_metres);
  if (part.x >= part.y) return {1, 0};
  const Vec3f away = layer.orthographic ? Vec3f{0, 0, -1} : normalized(seen);
  const Vec2f behind{o.thickness_metres * dot(away, s.tangent), o.thickness_metres * dot(away, s.view)};
  Vec2f ends{1e30f, -1e30f};
  for (const float share : {part.x, part.y}) {
    const float x = a.x + share * (b.x - a.x), y = a.y + share * (b.y - a.y);
    const float front = sign * std::atan2(x, y);
    float back = sign * std::atan2(x + behind.x, y + behind.y);
    if (back < 0) back = pi;
    ends = {std::min({ends.x, front, back}), std::max({ends.y, front, back})};
  }
  return ends;
}

std::uint32_t hidden_sectors(const DepthLayer& layer, const OcclusionOptions& o, const Pixel& p,
                             const Slice& s, int i, float reach) {
  const float low = s.angle - pi / 2, high = s.angle + pi / 2, total = s.cosine + s.angle * s.sine;
  const float below = slice_measure(low, s);
  const auto share_below = [&](float angle) {
    return std::clamp((below + (angle < 0 ? -1.0f : 1.0f) * slice_measure(angle, s)) / total, 0.0f, 1.0f);
  };
  std::uint32_t mask = 0;
  for (int j = 0; j < 2 * o.steps; ++j) {
    const float sign = j % 2 == 0 ? 1.0f : -1.0f, step = static_cast<float>(j / 2);
    const float u =
        fraction(p.noise.y + static_cast<float>(i) * 0.6180339887f + static_cast<float>(j % 2) * 0.5f);
    const auto edge = [&](float v) {
      return 0.5f + reach * std::pow((step + v) / static_cast<float>(o.steps), o.step_power);
    };
    const Vec2f found = hidden_angles(layer, o, p, s, sign, {edge(0), edge(u), edge(1)});
    if (found.x > found.y) continue;
    const float from = std::clamp(sign > 0 ? found.x : -found.y, low, high);
    const float to = std::clamp(sign > 0 ? found.y : -found.x, low, high);
    mask |= sectors(share_below(from), share_below(to), p.noise.x);
  }
  return mask;
}

float sectors_pixel(const DepthLayer& layer, const OcclusionOptions& o, const Pixel& p, float reach) {
  float open = 0, all = 0;
  for (int i = 0; i < o.slices; ++i) {
    const float turn = pi * (static_cast<float>(i) + p.noise.x) / static_cast<float>(o.slices);
    const Slice s = slice_about_view(turn, p, layer.orthographic);
    const float weight = s.projected * (s.cosine + s.angle * s.sine);
    const int hidden = std::popcount(hidden_sectors(layer, o, p, s, i, reach));
    open += weight * (1 - static_cast<float>(hidden) / 32);
    all += weight;
  }
  return std::clamp(open / std::max(all, 1e-6f), 0.0f, 1.0f);
}

template <class Value>
Image for_each_pixel(const DepthLayer& layer, const Value& value) {
  Image image(layer.width, layer.height, 1);
  parallel_for(static_cast<std::size_t>(layer.height), 4, [&](std::size_t begin, std::size_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const int y = layer.height - 1 - row;
      for (int x = 0; x < layer.width; ++x)
        *image.at(x, row) = layer.depth[layer.index(x, y)] > 0 ? value(x, y) : 1.0f;
    }
  });
  return image;
}

// One round of the filter: along x or along y.
float filtered(const DepthLayer& layer, const Image& openness, float radius, int x, int y, bool upwards) {
  const std::size_t here = layer.index(x, y);
  const Vec3f position = layer.point_of_pixel(x, y), normal = layer.normal[here];
  const float size = 0.05f / pixels_per_metre(layer, layer.depth[here]);
  float sum = *openness.at(x, layer.height - 1 - y), weights = 1;
  for (int i = -2; i <= 2; ++i) {
    const int column = upwards ? x : x + i, row = upwards ? y + i : y;
    if (i == 0 || column < 0 || row < 0 || column >= layer.width || row >= layer.height) continue;
    const std::size_t there = layer.index(column, row);
    if (layer.depth[there] <= 0) continue;
    const Vec3f to = layer.point_of_pixel(column, row) - position, other = layer.normal[there];
    const float off = std::max(std::max(std::abs(dot(to, normal)), std::abs(dot(to, other))) - size, 0.0f);
    const float a = off / (occlusion_noise_scale.x * radius),
                b = length(to) / (occlusion_noise_scale.y * radius);
    const float c = length(other - normal) / occlusion_noise_scale.z;
    const float weight = (std::abs(i) == 2 ? 0.5f : 1.0f) / (1 + a * a + b * b + c * c);
    sum += weight * *openness.at(column, layer.height - 1 - row);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

Image slice_occlusion(const DepthLayer& layer, const OcclusionOptions& options) {
  assert(options.method == OcclusionMethod::gtao || options.method == OcclusionMethod::horizon_sectors);
  return for_each_pixel(layer, [&](int x, int y) {
    const Pixel p = pixel_at(layer, x, y);
    const float metre = pixels_per_metre(layer, layer.depth[layer.index(x, y)]);
    const float reach = std::min(options.radius_metres * metre, options.largest_radius_pixels);
    return options.method == OcclusionMethod::gtao ? gtao_pixel(layer, options, p, reach)
                                                   : sectors_pixel(layer, options, p, reach);
  });
}

Image denoise_occlusion(const DepthLayer& layer, const Image& openness, float radius_metres) {
  const Image along = for_each_pixel(
      layer, [&](int x, int y) { return filtered(layer, openness, radius_metres, x, y, false); });
  return for_each_pixel(layer,
                        [&](int x, int y) { return filtered(layer, along, radius_metres, x, y, true); });
}

}  // namespace welkin
