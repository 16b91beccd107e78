#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include <welkin/geometry/fast_angles.h>
#include <welkin/geometry/vec3f.h>
#include <welkin/scene/scene.h>

// The value of a texture at a point of a surface. No mip levels: a pixel's samples do the filtering.

namespace welkin {

/// Red, green, blue and alpha; a texture of one channel gives it thrice, alpha is 1 where there is none.
using Texel = std::array<float, 4>;

/// uv of KHR_texture_transform: scaled, then turned counter-clockwise as the extension's matrix does it, then moved.
inline Vec2f transformed_texcoord(const TextureUse& use, Vec2f uv) {
  const Vec2f scaled{uv.x * use.scale.x, uv.y * use.scale.y};
  if (use.rotation_radians == 0) return scaled + use.offset;
  const float c = std::cos(use.rotation_radians), s = std::sin(use.rotation_radians);
  return Vec2f{c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x} + use.offset;
}

/// A texel's index in [0, size) for any whole number.
inline int wrapped_index(int i, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(i, 0, size - 1);
  if (wrap == TextureWrap::mirror) {
    const int m = ((i % (2 * size)) + 2 * size) % (2 * size);
    return m < size ? m : 2 * size - 1 - m;
  }
  return ((i % size) + size) % size;
}

/// t with the whole periods taken off (two for mirror), so that it can be turned into an index whatever it was.
inline float within_periods(float t, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(t, -1.0f, 2.0f);
  return t - 2 * std::floor(0.5f * t);
}

inline Texel texel_at(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  switch (image.channels) {
    case 1: return {p[0], p[0], p[0], 1};
    case 3: return {p[0], p[1], p[2], 1};
    default: return {p[0], p[1], p[2], p[3]};
  }
}

/// The texture at uv, (0, 0) the corner of the top left texel; bilinear between texel centres unless texture.nearest.
inline Texel look_up(const Texture& texture, Vec2f uv) {
  const Image& image = texture.image;
  const float x = within_periods(uv.x, texture.wrap_u) * static_cast<float>(image.width);
  const float y = within_periods(uv.y, texture.wrap_v) * static_cast<float>(image.height);
  const auto column = [&](float at) {
    return wrapped_index(static_cast<int>(at), image.width, texture.wrap_u);
  };
  const auto row = [&](float at) {
    return wrapped_index(static_cast<int>(at), image.height, texture.wrap_v);
  };
  if (texture.nearest) return texel_at(image, column(std::floor(x)), row(std::floor(y)));
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float fx = x - 0.5f - left, fy = y - 0.5f - top;
  const int x0 = column(left), x1 = column(left + 1), y0 = row(top), y1 = row(top + 1);
  const Texel a = texel_at(image, x0, y0), b = texel_at(image, x1, y0);
  const Texel c = texel_at(image, x0, y1), d = texel_at(image, x1, y1);
  Texel result;
  for (int i = 0; i < 4; ++i) {
    result[i] = (1 - fy) * ((1 - fx) * a[i] + fx * b[i]) + fy * ((1 - fx) * c[i] + fx * d[i]);
  }
  return result;
}

/// What `use` reads at a point with these two texture coordinates; needs use.texture >= 0.
inline Texel look_up(const Scene& scene, const TextureUse& use, const Vec2f (&texcoords)[2]) {
  return look_up(scene.textures[use.texture], transformed_texcoord(use, texcoords[use.texcoord]));
}

/// Texture coordinates of a sphere: those of an equirectangular map, looked up along the unit normal.
inline Vec2f sphere_texcoord(Vec3f normal) {
  const float across = std::sqrt(normal.x * normal.x + normal.z * normal.z);
  return {atan2_turns(normal.z, normal.x) + 0.5f, 2 * atan2_turns(across, normal.y)};
}

/// A material's coverage at a point, for AlphaMode::mask and blend.
inline float coverage_at(const Scene& scene, const Material& material, const Vec2f (&texcoords)[2]) {
  if (material.base_color_texture.texture < 0) return material.base_alpha;
  return material.base_alpha * look_up(scene, material.base_color_texture, texcoords)[3];
}

}  // namespace welkin
