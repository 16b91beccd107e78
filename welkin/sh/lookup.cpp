#include <welkin/sh/lookup.h>

#include <algorithm>
#include <span>
#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

void check(MapShape shape, int max_degree) {
  check_map_shape(shape);
  if (max_degree < 0 || max_degree > max_lookup_degree)
    throw Error("the degree of a look-up table must be between 0 and " + std::to_string(max_lookup_degree));
}

std::size_t texel_count(MapShape shape) { return static_cast<std::size_t>(shape.width) * shape.height; }

// Calls texel(x, y, index) for all texels.
template <class Texel>
void for_each_texel(MapShape shape, Texel&& texel) {
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) texel(x, y, static_cast<std::size_t>(y) * shape.width + x);
}

// Makes values[i * texels + texel] = sum over the texel's add(direction, weight) calls of weight * Y_i.
template <class Texel>
std::vector<float> tabulate(MapShape shape, int max_degree, Texel&& texel) {
  const std::size_t functions = sh_count(max_degree);
  std::vector<float> values(functions * texel_count(shape));
  std::vector<double> basis(functions), sum(functions);
  for_each_texel(shape, [&](int x, int y, std::size_t index) {
    std::fill(sum.begin(), sum.end(), 0.0);
    texel(x, y, [&](Vec3 direction, double weight) {
      evaluate_sh_basis(direction, max_degree, basis);
      for (std::size_t i = 0; i < functions; ++i) sum[i] += weight * basis[i];
    });
    for (std::size_t i = 0; i < functions; ++i)
      values[i * texel_count(shape) + index] = static_cast<float>(sum[i]);
  });
  return values;
}

ShCoefficients project_texels(const ShProjectionLookup& lookup, std::span<const float> texels, int channels) {
  ShCoefficients result(lookup.max_degree, channels);
  const std::size_t count = texel_count(lookup.shape);
  for (std::size_t i = 0; i < sh_count(lookup.max_degree); ++i) {
    double* sum = &result.values[i * channels];
    for (std::size_t k = 0; k < count; ++k)
      for (int c = 0; c < channels; ++c)
        sum[c] += static_cast<double>(lookup.values[i * count + k]) * texels[k * channels + c];
  }
  return result;
}

}  // namespace

ShProjectionLookup make_sh_projection_lookup(MapShape shape, int max_degree, TexelRule rule) {
  check(shape, max_degree);
  if (rule == TexelRule::centre)
    return {shape, max_degree, tabulate(shape, max_degree, [&](int x, int y, auto&& add) {
              add(map_texel_direction(shape, x, y), map_texel_solid_angle(shape, x, y));
            })};
  TexelNodes nodes(shape, max_degree, rule);
  return {shape, max_degree, tabulate(shape, max_degree, [&](int x, int y, auto&& add) {
            for (const TexelNode& node : nodes.of(x, y)) add(nodes.direction(x, y, node), node.weight);
          })};
}

ShCoefficients project(const ShProjectionLookup& lookup, const SphereMap& radiance) {
  const MapShape shape = radiance.shape();
  if (shape.mapping != lookup.shape.mapping || shape.width != lookup.shape.width ||
      shape.height != lookup.shape.height)
    throw Error("the look-up table is for a map of another shape");
  return project_texels(lookup, radiance.image.pixels, radiance.image.channels);
}

ShCoefficients project(const ShProjectionLookup& lookup, const Cube& radiance) {
  if (lookup.shape.mapping != Mapping::cube || lookup.shape.width != radiance.size)
    throw Error("the look-up table is for a map of another shape");
  return project_texels(lookup, radiance.texels, radiance.channels);
}

ShSynthesisLookup make_sh_synthesis_lookup(MapShape shape, int max_degree) {
  check(shape, max_degree);
  return {shape, max_degree, tabulate(shape, max_degree, [&](int x, int y, auto&& add) {
            add(map_texel_direction(shape, x, y), 1.0);
          })};
}

SphereMap synthesize(const ShSynthesisLookup& lookup, const ShCoefficients& coefficients) {
  SphereMap map = make_sphere_map(lookup.shape, coefficients.channels);
  const std::size_t count = texel_count(lookup.shape);
  const std::size_t functions = sh_count(std::min(lookup.max_degree, coefficients.max_degree));
  for (std::size_t k = 0; k < count; ++k) {
    for (int c = 0; c < coefficients.channels; ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < functions; ++i)
        sum += coefficients.values[i * coefficients.channels + c] * lookup.values[i * count + k];
      map.image.pixels[k * coefficients.channels + c] = static_cast<float>(sum);
    }
  }
  return map;
}

}  // namespace welkin
