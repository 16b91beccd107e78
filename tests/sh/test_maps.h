#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <welkin/sampling/sequence.h>
#include <welkin/sh/projection.h>
#include <welkin/sphere/mapping.h>

namespace welkin {

/// A map whose texels hold radiance(direction of their centre, channel), also outside the discs.
template <class Function>
SphereMap sphere_map_of(MapShape shape, int channels, Function&& radiance) {
  SphereMap map = make_sphere_map(shape, channels);
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x)
      for (int c = 0; c < channels; ++c)
        map.image.at(x, y)[c] = static_cast<float>(radiance(map_texel_direction(shape, x, y), c));
  return map;
}

/// Every number independent and uniform in [0, 1).
inline SphereMap random_map(MapShape shape, int channels, std::uint64_t seed = 1) {
  SphereMap map = make_sphere_map(shape, channels);
  for (float& value : map.image.pixels) value = static_cast<float>(mix_bits(seed++) >> 40) * 0x1p-24f;
  return map;
}

template <class A, class B>
double largest_difference(const A& a, const B& b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - b[i]));
  return largest;
}

template <class A>
double largest_of(const A& a) {
  double largest = 0;
  for (double value : a) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace welkin
