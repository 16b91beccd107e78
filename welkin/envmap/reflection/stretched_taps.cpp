#include <welkin/envmap/reflection/stretched_taps.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace welkin {
namespace {

struct Axis {
  int first, second;
  double share;  // of the second
};

Axis axis(double coordinate, int size) {
  const double x = std::clamp(coordinate * size - 0.5, 0.0, size - 1.0);
  const int first = static_cast<int>(x);
  return {first, std::min(first + 1, size - 1), x - first};
}

void add(StretchedTap& sum, double weight, const StretchedTap& tap) {
  sum.offset += weight * tap.offset;
  sum.perceptual_roughness += weight * tap.perceptual_roughness;
  sum.scale += weight * tap.scale;
  sum.bias += weight * tap.bias;
}

}  // namespace

std::vector<StretchedTap> look_up_stretched_taps(const StretchedTapsTable& table, double cos_view,
                                                 double perceptual_roughness) {
  assert(!table.texels.empty() && cos_view >= 0);
  const Axis x = axis(std::sqrt(cos_view), table.cos_size);
  const Axis y = axis(perceptual_roughness, table.roughness_size);
  std::vector<StretchedTap> taps(table.taps);
  const auto mix = [&](int i, int j, double weight) {
    const std::size_t texel = (static_cast<std::size_t>(j) * table.cos_size + i) * table.taps;
    for (int k = 0; k < table.taps; ++k) add(taps[k], weight, table.texels[texel + k]);
  };
  mix(x.first, y.first, (1 - x.share) * (1 - y.share));
  mix(x.second, y.first, x.share * (1 - y.share));
  mix(x.first, y.second, (1 - x.share) * y.share);
  mix(x.second, y.second, x.share * y.share);
  return taps;
}

Image stretched_taps_image(const StretchedTapsTable& table) {
  Image image(table.cos_size, 2 * table.taps * table.roughness_size, 2);
  for (int j = 0; j < table.roughness_size; ++j)
    for (int i = 0; i < table.cos_size; ++i)
      for (int k = 0; k < table.taps; ++k) {
        const StretchedTap& tap =
            table.texels[(static_cast<std::size_t>(j) * table.cos_size + i) * table.taps + k];
        float* where = image.at(i, 2 * k * table.roughness_size + j);
        where[0] = static_cast<float>(tap.offset);
        where[1] = static_cast<float>(tap.perceptual_roughness);
        float* weight = image.at(i, (2 * k + 1) * table.roughness_size + j);
        weight[0] = static_cast<float>(tap.scale);
        weight[1] = static_cast<float>(tap.bias);
      }
  return image;
}

std::string stretched_taps_glsl(const StretchedTapsTable& table) {
  constexpr const char* text =
      R"(// Reflected radiance of a GGX surface by {0} look-ups of the prefiltered map.
// taps_map: linear filtering, clamp to edge, no mip levels. level_of(r): the level law of the specular map.
uniform samplerCube specular_map;
uniform sampler2D dfg_map, taps_map;
uniform float specular_scale;  // stored_scale of the specular map

vec3 stretched_reflection(vec3 n, vec3 v, vec3 f0, float r) {{  // r = perceptual_roughness
  float n_v = clamp(dot(n, v), 0.0, 1.0);
  vec3 mirrored = reflect(-v, n);
  // Row blocks are read to half a texel from their ends, so that none bleeds into the next.
  vec2 at = vec2(sqrt(n_v), clamp(r, {1:.8f}, {2:.8f}));
  vec3 sum = vec3(0.0), weights = vec3(0.0);
  for (int k = 0; k < {0}; ++k) {{
    vec2 place = texture(taps_map, vec2(at.x, (at.y + float(2 * k)) / {3:.1f})).rg;
    vec2 share = texture(taps_map, vec2(at.x, (at.y + float(2 * k + 1)) / {3:.1f})).rg;
    vec3 weight = f0 * share.r + share.g;
    vec3 direction = mirrored + place.r * (n_v * mirrored - n);
    sum += weight * textureLod(specular_map, direction, level_of(place.g)).rgb;
    weights += weight;
  }}
  vec2 dfg = texture(dfg_map, vec2(n_v, r)).rg;
  return specular_scale * max(sum, vec3(0.0)) * (f0 * dfg.r + dfg.g) / weights;
}}
)";
  return fmt::format(text, table.taps, 0.5 / table.roughness_size, 1 - 0.5 / table.roughness_size,
                     2.0 * table.taps);
}

StretchedTaps prepare_stretched_taps(const Image& radiance, const std::array<double, 3>& f0, double alpha,
                                     const PrefilterOptions& options, const StretchedTapsOptions& table) {
  SplitSum plain = prepare_split_sum(radiance, f0, alpha, options);
  StretchedTapsTable fitted = make_stretched_taps_table(plain.chain.shape(), table);
  return {std::move(plain.chain), std::move(fitted), f0, alpha};
}

std::array<double, 3> reflect(const StretchedTaps& surface, const ReflectionQuery& query) {
  const double cos_view = std::min(1.0, dot(query.normal, query.view));
  if (cos_view <= 0) return {};
  const Vec3 mirrored = 2 * cos_view * query.normal - query.view;
  std::array<double, 3> sum{}, weights{};
  for (const StretchedTap& tap : look_up_stretched_taps(surface.table, cos_view, std::sqrt(surface.alpha))) {
    const Vec3 direction = mirrored + tap.offset * (cos_view * mirrored - query.normal);
    const std::array<double, 3> rgb = look_up(surface.chain, direction, tap.perceptual_roughness);
    for (int c = 0; c < 3; ++c) {
      const double weight = surface.f0[c] * tap.scale + tap.bias;
      sum[c] += weight * rgb[c];
      weights[c] += weight;
    }
  }
  const DfgValue dfg = integrate_dfg(cos_view, surface.alpha);
  for (int c = 0; c < 3; ++c)
    sum[c] = std::max(0.0, sum[c]) * (surface.f0[c] * dfg.scale + dfg.bias) / weights[c];
  return sum;
}

}  // namespace welkin
