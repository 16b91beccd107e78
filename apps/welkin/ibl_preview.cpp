#include "ibl_preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include <fmt/format.h>

#include <welkin/brdf/ggx.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/equirect.h>

#include "picture.h"

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

constexpr ByteColour paper{26, 27, 30}, ink{222, 221, 216}, faint{146, 148, 152}, accent{242, 184, 92};

// The sheet, in pixels.
constexpr int sheet_width = 1280, margin = 30, gap = 20, content_width = sheet_width - 2 * margin;
constexpr int text_scale = 2, line_height = text_scale * text_height;
constexpr int title_height = 70, heading_height = line_height + 14, caption_height = line_height + 10;
constexpr int section_gap = 26;
constexpr int columns = 3;
constexpr int cell_width = (content_width - (columns - 1) * gap) / columns, cell_height = cell_width / 2;
constexpr int strip_height = 150, metal_count = 9;
constexpr double metal_radius = 58;
constexpr int tile = (content_width - 3 * gap) / 5;  // two spheres, a panorama twice as wide, the table
constexpr double tile_radius = 92;

// The sheet from top to bottom.
struct Layout {
  int chain_y = 0, metal_y = 0, tiles_y = 0, height = 0;
};

Layout lay_out(const IblSet& set) {
  const int rows = (static_cast<int>(set.specular.levels.size()) + columns - 1) / columns;
  Layout layout;
  layout.chain_y = title_height + heading_height;
  layout.metal_y = layout.chain_y + rows * (cell_height + caption_height + 8) + section_gap + heading_height;
  layout.tiles_y = layout.metal_y + strip_height + caption_height + section_gap;
  layout.height = layout.tiles_y + tile + caption_height + margin;
  return layout;
}

int tile_x(int index) { return margin + index * (tile + gap); }

// What the spheres are lit by, and how bright they are shown.
struct Light {
  const IblSet& set;
  std::span<const DirectionalLight> lights;
  const Cube& irradiance;  // of the set and the lights
  LevelLaw law;
  ToneMapOptions tone;
};

void glossy_radiance(const Light& light, Vec3 direction, double perceptual_roughness, float* rgb) {
  const CubeMips& chain = light.set.specular;
  const int levels = static_cast<int>(chain.levels.size());
  look_up_cube(chain, direction,
               perceptual_roughness_to_level(light.law, perceptual_roughness, levels, chain.size()), rgb);
}

// A mirror shows more texels than it has pixels: like a GPU, take the mip level where a texel is as large as what a
// pixel reflects. On a sphere seen in parallel projection that is the same solid angle everywhere, 4 / radius^2 (the
// reflected direction turns twice as fast as the normal, which cancels the slant of the surface). Half a level sharper,
// because four samples make a pixel.
double mirror_level(int size, double radius) {
  const double texel = 4 * pi / 6 / (static_cast<double>(size) * size);
  return std::max(0.0, 0.5 * std::log2(4 / (radius * radius) / texel) - 1.5);
}

// Reflected by a glossy surface from a light that the maps do not have. A light of radius a is seen in a mirror as a spot
// that a lobe of alpha = a / 2 has too.
void add_highlight(const DirectionalLight& light, const PreviewMaterial& material, Vec3 normal, float* rgb) {
  const Vec3 view{0, 0, 1}, half = normalized(light.direction + view);
  const double cos_light = dot(normal, light.direction);
  if (!(cos_light > 0)) return;
  const double own = material.perceptual_roughness * material.perceptual_roughness;
  const double alpha = std::max(0.002, std::hypot(own, light.angular_radius / 2));
  const double lobe = ggx_distribution(dot(normal, half), alpha) * ggx_visibility(normal.z, cos_light, alpha);
  for (int c = 0; c < 3; ++c)
    rgb[c] += static_cast<float>(fresnel_schlick(dot(view, half), material.f0[c]) * lobe * cos_light *
                                 light.irradiance[c]);
}

// The set's irradiance with that of the lights.
Cube lit(const Cube& irradiance, std::span<const DirectionalLight> lights) {
  Cube sum = irradiance;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < sum.size; ++y)
      for (int x = 0; x < sum.size; ++x)
        for (const DirectionalLight& light : lights) {
          const auto part = disc_irradiance(light, cube_texel_direction(sum.size, face, x, y));
          for (int c = 0; c < 3; ++c) sum.at(face, x, y)[c] += static_cast<float>(part[c]);
        }
  return sum;
}

void shade(const Light& light, const PreviewSphere& sphere, Vec3 normal, float* rgb) {
  const PreviewMaterial& material = sphere.material;
  const double cos_view = normal.z, roughness = material.perceptual_roughness;
  float diffuse[3] = {}, glossy[3] = {};
  const bool matt =
      std::any_of(material.albedo.begin(), material.albedo.end(), [](double a) { return a > 0; });
  if (matt) look_up_cube(light.irradiance, normal, diffuse);
  DfgValue dfg;
  if (material.glossy) {
    const Vec3 reflected = 2 * cos_view * normal - Vec3{0, 0, 1};
    dfg = look_up_dfg(light.set.dfg, cos_view, roughness);
    if (roughness > 0) {
      glossy_radiance(light, reflected, roughness, glossy);
    } else {
      const CubeMips& sharp = light.set.environment;  // level 0 of the specular chain, with its own mips
      look_up_cube(sharp, reflected, mirror_level(sharp.size(), sphere.radius), glossy);
    }
  }
  for (int c = 0; c < 3; ++c) {
    const double reflectance = material.f0[c] * dfg.scale + dfg.bias;
    const double let_through = (1 - reflectance) * material.albedo[c];
    rgb[c] = static_cast<float>(reflectance * glossy[c] + let_through * diffuse[c] / pi);
  }
  if (material.glossy)
    for (const DirectionalLight& extra : light.lights) add_highlight(extra, material, normal, rgb);
}

// A rectangle of the sheet that shows spheres before the environment.
struct Scene {
  int x = 0, y = 0, width = 0, height = 0;
  double focal = 0;  // of the pinhole camera behind the spheres, pixels
};

// The environment behind the spheres, blurred, at (x, y) of the sheet.
void background(const Light& light, const Scene& scene, double x, double y, float* rgb) {
  constexpr double roughness = 0.2;
  const Vec3 ray{x - (scene.x + 0.5 * scene.width), scene.y + 0.5 * scene.height - y, -scene.focal};
  glossy_radiance(light, ray, roughness, rgb);
}

// Lays a sphere over what is in rgb at (x, y) of the sheet; step is the distance between samples.
void cover(const Light& light, const PreviewSphere& sphere, double x, double y, double step, float* rgb) {
  const double dx = x - sphere.x, dy = sphere.y - y, distance = std::hypot(dx, dy);
  const double coverage = std::clamp((sphere.radius - distance) / step + 0.5, 0.0, 1.0);
  if (coverage <= 0) return;
  const double inside = 1 / std::max(sphere.radius, distance);
  const double nx = dx * inside, ny = dy * inside;
  float surface[3];
  shade(light, sphere, {nx, ny, std::sqrt(std::max(0.0, 1 - nx * nx - ny * ny))}, surface);
  for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(rgb[c] + coverage * (surface[c] - rgb[c]));
}

constexpr int scene_samples = 2;  // a side of a pixel

// One row of pixels, to scene_samples rows of the image; the background is smooth enough for one look-up a pixel.
void render_row(const Light& light, const Scene& scene, std::span<const PreviewSphere> spheres, int row,
                Image& image) {
  constexpr double step = 1.0 / scene_samples;
  for (int column = 0; column < scene.width; ++column) {
    float behind[3];
    background(light, scene, scene.x + column + 0.5, scene.y + row + 0.5, behind);
    for (int k = 0; k < scene_samples * scene_samples; ++k) {
      const int i = column * scene_samples + k % scene_samples, j = row * scene_samples + k / scene_samples;
      float* pixel = image.at(i, j);
      std::copy_n(behind, 3, pixel);
      for (const PreviewSphere& sphere : spheres)
        cover(light, sphere, scene.x + (i + 0.5) * step, scene.y + (j + 0.5) * step, step, pixel);
    }
  }
}

ByteImage render_scene(const Light& light, const Scene& scene, std::span<const PreviewSphere> spheres) {
  Image image(scene.width * scene_samples, scene.height * scene_samples);
  parallel_for(scene.height, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      render_row(light, scene, spheres, static_cast<int>(row), image);
  });
  return shrink(tone_map(image, light.tone), scene_samples);
}

// A cube as an equirectangular panorama, times scale.
ByteImage panorama(const Cube& cube, int width, double scale, const ToneMapOptions& tone) {
  const int samples = std::clamp((4 * cube.size + width / 2) / width, 1, 3);  // about as fine as the texels
  Image image(width * samples, width / 2 * samples);
  parallel_for(image.height, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      for (int i = 0; i < image.width; ++i) {
        float* pixel = image.at(i, static_cast<int>(j));
        const Uv uv{(i + 0.5) / image.width, (static_cast<double>(j) + 0.5) / image.height};
        look_up_cube(cube, equirect_direction(uv), pixel);
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(scale * pixel[c]);
      }
  });
  return shrink(tone_map(image, tone), samples);
}

// Level 0 can have many texels a pixel; the environment is the same map with mips.
const Cube& level_to_show(const IblSet& set, std::size_t level) {
  if (level > 0) return set.specular.levels[level];
  std::size_t mip = 0;
  while (mip + 1 < set.environment.levels.size() && set.environment.levels[mip].size * 3 > cell_width) ++mip;
  return set.environment.levels[mip];
}

// cos_view rightwards, perceptual roughness downwards; scale in red, bias in green.
ByteImage dfg_picture(const DfgTable& table, int size) {
  ByteImage picture(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const DfgValue value = look_up_dfg(table, (x + 0.5) / size, (y + 0.5) / size);
      picture.at(x, y)[0] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value.scale, 0.0, 1.0)));
      picture.at(x, y)[1] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value.bias, 0.0, 1.0)));
    }
  return picture;
}

void caption(ByteImage& sheet, int x, int y, std::string_view name, std::string_view rest) {
  const int behind = draw_text(sheet, x, y, text_scale, name, ink);
  draw_text(sheet, behind + 5 * text_scale, y, text_scale, rest, faint);
}

std::string kernel_name(const IblSet& set) {
  const std::string text = set.levels.size() > 1 ? describe(set.levels.back().kernel) : "";
  return text.substr(0, text.find(' '));
}

void draw_title(ByteImage& sheet, const Light& light) {
  const int x = draw_text(sheet, margin, 24, 3, "welkin", accent) + gap;
  const double tenths = std::round(10 * light.tone.exposure_ev.value_or(0)) + 0.0;  // + 0: never minus zero
  const CubeMips& chain = light.set.specular;
  const std::string beside =
      light.lights.empty() ? "" : fmt::format(", lights beside the set: {}", light.lights.size());
  draw_text(sheet, x, 29, text_scale,
            fmt::format("{} texels, {} levels, {}, exposure {:+.1f} EV{}", chain.size(), chain.levels.size(),
                        name(light.law), tenths / 10, beside),
            faint);
}

void draw_chain(ByteImage& sheet, const Light& light, const Layout& layout) {
  caption(sheet, margin, layout.chain_y - heading_height, "specular",
          fmt::format("{}, r = perceptual roughness, alpha = r^2, +X in the middle", kernel_name(light.set)));
  for (std::size_t k = 0; k < light.set.specular.levels.size(); ++k) {
    const int x = margin + static_cast<int>(k) % columns * (cell_width + gap);
    const int y = layout.chain_y + static_cast<int>(k) / columns * (cell_height + caption_height + 8);
    blit(panorama(level_to_show(light.set, k), cell_width, 1, light.tone), sheet, x, y);
    const IblLevel& level = light.set.levels[k];
    caption(sheet, x, y + cell_height + 8, fmt::format("level {}", k),
            fmt::format("r {:.3f} alpha {:.3f}", level.perceptual_roughness, level.alpha));
  }
}

void draw_metals(ByteImage& sheet, const Light& light, const Layout& layout,
                 std::span<const PreviewSphere> metals) {
  const auto& f0 = metals.front().material.f0;
  caption(
      sheet, margin, layout.metal_y - heading_height, "silver",
      fmt::format("F0 {:.2f} {:.2f} {:.2f}, by perceptual roughness, seen along -Z", f0[0], f0[1], f0[2]));
  const Scene scene{margin, layout.metal_y, content_width, strip_height, 620};
  blit(render_scene(light, scene, metals), sheet, scene.x, scene.y);
  for (const PreviewSphere& sphere : metals) {
    const std::string text = fmt::format("{:g}", sphere.material.perceptual_roughness);
    const int x = static_cast<int>(sphere.x) - text_width(text, text_scale) / 2;
    draw_text(sheet, x, layout.metal_y + strip_height + 8, text_scale, text, ink);
  }
}

void draw_tiles(ByteImage& sheet, const Light& light, const Layout& layout,
                std::span<const PreviewSphere> spheres) {
  for (int k = 0; k < 2; ++k) {
    const Scene scene{tile_x(k), layout.tiles_y, tile, tile, 200};
    blit(render_scene(light, scene, spheres.subspan(k, 1)), sheet, scene.x, scene.y);
  }
  const int y = layout.tiles_y + tile + 8;
  caption(sheet, tile_x(0), y, "matt", "albedo 0.8");
  caption(sheet, tile_x(1), y, "red", "F0 0.04 r 0.25");
  blit(panorama(light.set.irradiance, 2 * tile, 1 / pi, light.tone), sheet, tile_x(2), layout.tiles_y);
  caption(sheet, tile_x(2), y, "irradiance / pi", "");
  const int dfg_x = tile_x(3) + tile;
  blit(dfg_picture(light.set.dfg, tile), sheet, dfg_x, layout.tiles_y);
  caption(sheet, dfg_x, y, "DFG", "n.v, r");
}

}  // namespace

LevelLaw level_law_of(const IblSet& set) {
  LevelLaw best = LevelLaw::linear;
  double smallest = std::numeric_limits<double>::infinity();
  const int levels = static_cast<int>(set.levels.size());
  for (LevelLaw law : {LevelLaw::linear, LevelLaw::quadratic, LevelLaw::logarithmic}) {
    double difference = 0;
    for (int k = 0; k < levels; ++k)
      difference += std::abs(level_to_perceptual_roughness(law, k, levels, set.specular.size()) -
                             set.levels[k].perceptual_roughness);
    if (difference < smallest) smallest = difference, best = law;
  }
  return best;
}

ToneMapOptions preview_tone(const IblSet& set, std::span<const DirectionalLight> lights) {
  const auto exposure_of = [](const Cube& cube) {
    Image texels(cube.size, 6 * cube.size);
    texels.pixels = cube.texels;
    return automatic_exposure_ev(texels);
  };
  std::size_t mip = 0;
  while (set.environment.levels[mip].size > 64 && mip + 1 < set.environment.levels.size()) ++mip;
  const double by_irradiance = exposure_of(lit(set.irradiance, lights)) + std::log2(pi);
  ToneMapOptions tone;
  tone.exposure_ev = 0.5 + 0.75 * by_irradiance + 0.25 * exposure_of(set.environment.levels[mip]);
  tone.white = 6;
  return tone;
}

std::vector<PreviewSphere> preview_spheres(const IblSet& set) {
  const Layout layout = lay_out(set);
  std::vector<PreviewSphere> spheres;
  for (int k = 0; k < metal_count; ++k) {
    const PreviewMaterial silver{true, {0.97, 0.96, 0.91}, k / (metal_count - 1.0), {}};
    spheres.push_back({silver, margin + (k + 0.5) * content_width / metal_count,
                       layout.metal_y + strip_height / 2.0, metal_radius});
  }
  const double y = layout.tiles_y + tile / 2.0;
  spheres.push_back({{false, {}, 0, {0.8, 0.8, 0.8}}, tile_x(0) + tile / 2.0, y, tile_radius});
  spheres.push_back(
      {{true, {0.04, 0.04, 0.04}, 0.25, {0.7, 0.08, 0.05}}, tile_x(1) + tile / 2.0, y, tile_radius});
  return spheres;
}

ByteImage make_preview(const IblSet& set, std::span<const DirectionalLight> lights) {
  assert(!set.specular.empty() && set.levels.size() == set.specular.levels.size() &&
         !set.environment.empty());
  assert(!set.irradiance.empty() && set.dfg.size > 0);
  const Cube irradiance = lit(set.irradiance, lights);
  const Light light{set, lights, irradiance, level_law_of(set), preview_tone(set, lights)};
  const Layout layout = lay_out(set);
  const std::vector<PreviewSphere> spheres = preview_spheres(set);
  ByteImage sheet(sheet_width, layout.height);
  fill_box(sheet, 0, 0, sheet.width, sheet.height, paper);
  draw_title(sheet, light);
  draw_chain(sheet, light, layout);
  draw_metals(sheet, light, layout, std::span(spheres).first(metal_count));
  draw_tiles(sheet, light, layout, std::span(spheres).subspan(metal_count));
  return sheet;
}

}  // namespace welkin
