#include <welkin/envmap/lights.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <welkin/envmap/inpaint.h>
#include <welkin/envmap/light_regions.h>
#include <welkin/envmap/statistics.h>
#include <welkin/error.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr std::array<double, 3> luminance_weights{0.2126, 0.7152, 0.0722};

double luminance(const std::array<double, 3>& c) {
  return luminance_weights[0] * c[0] + luminance_weights[1] * c[1] + luminance_weights[2] * c[2];
}

void check(const LightOptions& options) {
  if (options.max_lights < 1) throw Error("the number of lights must be at least 1");
  if (!(options.max_angular_radius >= 0.05 && options.max_angular_radius <= 45))
    throw Error("the largest angular radius of a light must be 0.05 to 45 degrees");
  if (!(options.min_share >= 0 && options.min_share <= 1))
    throw Error("the smallest share of a light must be 0 to 1");
}

void add(LightRegion& into, LightRegion&& from) {
  into.texels.insert(into.texels.end(), from.texels.begin(), from.texels.end());
  into.solid_angle += from.solid_angle;
  into.area_moment = into.area_moment + from.area_moment;
  into.flux += from.flux;
}

// Joins each region to the strongest one before it with which it stays compact. Regions come strongest first; beyond the
// first few hundred they are specks.
std::vector<LightRegion> join_neighbours(std::vector<LightRegion> regions, double max_radius) {
  constexpr std::size_t most = 512;
  if (regions.size() > most) regions.resize(most);
  std::vector<LightRegion> sources;
  for (LightRegion& region : regions) {
    const auto home = std::find_if(sources.begin(), sources.end(), [&](const LightRegion& s) {
      const Vec3 moment = s.area_moment + region.area_moment;
      return equivalent_radius(s.solid_angle + region.solid_angle, moment) <= max_radius &&
             dot(normalized(s.area_moment), normalized(region.area_moment)) >= std::cos(2 * max_radius);
    });
    if (home == sources.end())
      sources.push_back(std::move(region));
    else
      add(*home, std::move(region));
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const LightRegion& a, const LightRegion& b) { return a.flux > b.flux; });
  return sources;
}

// The texels and all that touch them: the rim of a source is too dim for its region and too bright for the fill.
std::vector<std::uint32_t> with_rim(const Image& map, const std::vector<std::uint32_t>& texels) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t texel : texels) {
    const int x0 = static_cast<int>(texel) % map.width, y0 = static_cast<int>(texel) / map.width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        int x = x0 + dx, y = y0 + dy;
        if (y < 0 || y >= map.height) x += map.width / 2, y = y0;
        x = (x % map.width + map.width) % map.width;
        all.push_back(static_cast<std::uint32_t>(y) * map.width + x);
      }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// What one source takes out of the map.
struct Taken {
  std::array<Vec3, 3> vector_irradiance{};
  double flux = 0;          // luminance, W/m^2
  Vec3 flux_moment;         // integral of luminance times direction
  double texel_spread = 0;  // flux times the variance (rad^2, both axes) that a texel's own size adds
};

// Fills the texels of a map from around, nowhere above what they were.
void fill_below(Image& map, const std::vector<std::uint32_t>& texels, const std::vector<float>& before) {
  inpaint(map, texels);
  for (std::size_t i = 0; i < before.size(); ++i) {
    float& value = map.pixels[3 * std::size_t{texels[i / 3]} + i % 3];
    value = std::min(value, before[i]);
  }
}

std::vector<float> values_of(const Image& map, const std::vector<std::uint32_t>& texels) {
  std::vector<float> values;
  values.reserve(3 * texels.size());
  for (std::uint32_t t : texels)
    values.insert(values.end(), &map.pixels[3 * std::size_t{t}], &map.pixels[3 * std::size_t{t}] + 3);
  return values;
}

Taken difference(const std::vector<float>& before, const Image& map,
                 const std::vector<std::uint32_t>& texels) {
  Taken taken;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const int x = static_cast<int>(texels[i]) % map.width, y = static_cast<int>(texels[i]) / map.width;
    const double solid_angle = equirect_texel_solid_angle(map.width, map.height, y);
    const Vec3 moment = equirect_texel_moment(map.width, map.height, x, y);
    std::array<double, 3> excess{};
    for (int c = 0; c < 3; ++c) {
      excess[c] = static_cast<double>(before[3 * i + c] - map.at(x, y)[c]);
      taken.vector_irradiance[c] = taken.vector_irradiance[c] + excess[c] * moment;
    }
    const double flux = luminance(excess) * solid_angle;
    taken.flux += flux;
    taken.flux_moment = taken.flux_moment + luminance(excess) * moment;
    const double height = std::numbers::pi / map.height, width = solid_angle / height;
    taken.texel_spread += flux * (height * height + width * width) / 12;
  }
  return taken;
}

DirectionalLight to_light(const Taken& taken, double map_flux) {
  DirectionalLight light;
  const double moment = length(taken.flux_moment);
  light.direction = (1 / moment) * taken.flux_moment;
  for (int c = 0; c < 3; ++c)
    light.irradiance[c] = std::max(0.0, dot(taken.vector_irradiance[c], light.direction));
  light.illuminance = luminance(light.irradiance);
  for (int c = 0; c < 3; ++c) light.color[c] = light.irradiance[c] / light.illuminance;
  // The mean of 1 - cos over a disc is a^2 / 4; texels add half their own variance, once as patches and
  // once because they cannot tell where in them the light is.
  const double spread = 1 - moment / taken.flux - taken.texel_spread / taken.flux;
  light.angular_radius = 2 * std::sqrt(std::max(0.0, spread));
  light.share = taken.flux / map_flux;
  return light;
}

// Takes one source out of the residual, if it is worth a light.
void extract(const LightRegion& source, double map_flux, const LightOptions& options,
             ExtractedLights& result) {
  const std::vector<std::uint32_t> texels = with_rim(result.residual, source.texels);
  const std::vector<float> before = values_of(result.residual, texels);
  fill_below(result.residual, texels, before);
  const Taken taken = difference(before, result.residual, texels);
  if (taken.flux > 0 && taken.flux >= options.min_share * map_flux) {
    result.lights.push_back(to_light(taken, map_flux));
    return;
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    result.residual.pixels[3 * std::size_t{texels[i / 3]} + i % 3] = before[i];
}

// One search over the residual; returns whether it found a light.
bool extract_sources(double map_flux, const LightOptions& options, ExtractedLights& result) {
  LightRegionOptions region_options;
  region_options.max_angular_radius = options.max_angular_radius * std::numbers::pi / 180;
  const std::vector<LightRegion> sources =
      join_neighbours(find_light_regions(result.residual, region_options), region_options.max_angular_radius);
  const std::size_t before = result.lights.size();
  for (const LightRegion& source : sources) {
    if (static_cast<int>(result.lights.size()) == options.max_lights) break;
    if (source.flux < options.min_share * map_flux) break;
    extract(source, map_flux, options, result);
  }
  return result.lights.size() > before;
}

}  // namespace

ExtractedLights extract_lights(const Image& equirect, const LightOptions& options) {
  assert(equirect.channels == 3);
  check(options);
  if (static_cast<double>(equirect.width) * equirect.height >= 2147483648.0)
    throw Error("lights are taken out of maps below 2^31 texels; this one has more");
  ExtractedLights result;
  result.residual = equirect;
  const double map_flux = luminance(map_statistics(equirect).energy);
  while (static_cast<int>(result.lights.size()) < options.max_lights &&
         extract_sources(map_flux, options, result)) {
  }
  std::stable_sort(
      result.lights.begin(), result.lights.end(),
      [](const DirectionalLight& a, const DirectionalLight& b) { return a.illuminance > b.illuminance; });
  return result;
}

std::array<double, 3> directional_irradiance(const DirectionalLight& light, Vec3 normal) {
  const double cosine = std::max(0.0, dot(light.direction, normal));
  return {cosine * light.irradiance[0], cosine * light.irradiance[1], cosine * light.irradiance[2]};
}

// A disc of angular radius a about d, seen by a surface with normal n, t the angle between d and n. Lambert: the
// irradiance of unit radiance is half the integral of dot(n, r x dr) around what is visible. On the disc's edge,
// r = cos a d + sin a (cos p u + sin p v) with u in the plane of n and d, the integrand is
// sin^2 a cos t - sin a cos a sin t cos p, on the horizon 1. The horizon cuts the edge at p = p0,
// cos p0 = -cot a cot t, and takes the angle 2 h, cos h = cos a / sin t. Together
//   E = h + p0 sin^2 a cos t - sin a cos a sin t sin p0,
// and over the irradiance pi sin^2 a of a surface that faces the disc, E / (pi sin^2 a).
std::array<double, 3> disc_irradiance(const DirectionalLight& light, Vec3 normal) {
  const double cos_t = dot(light.direction, normal), a = light.angular_radius;
  const double sin_a = std::sin(a), cos_a = std::cos(a);
  double share = std::max(0.0, cos_t);
  if (std::abs(cos_t) < sin_a && sin_a > 1e-6) {
    const double sin_t = std::sqrt(std::max(0.0, 1 - cos_t * cos_t));
    const double cos_p0 = std::clamp(-cos_a * cos_t / (sin_a * sin_t), -1.0, 1.0);
    const double h = std::acos(std::clamp(cos_a / sin_t, -1.0, 1.0));
    const double e = h + std::acos(cos_p0) * sin_a * sin_a * cos_t -
                     sin_a * cos_a * sin_t * std::sqrt(1 - cos_p0 * cos_p0);
    share = std::max(0.0, e) / (std::numbers::pi * sin_a * sin_a);
  }
  return {share * light.irradiance[0], share * light.irradiance[1], share * light.irradiance[2]};
}

}  // namespace welkin
