#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include <welkin/image/image.h>

// Maps for tests.

namespace welkin {

inline Image constant_map(int width, int height, float value) {
  Image map(width, height);
  std::fill(map.pixels.begin(), map.pixels.end(), value);
  return map;
}

/// Uniform noise in [0, 2) with a mean of about 1.
inline Image noise_map(int width, int height, unsigned seed) {
  Image map(width, height);
  std::mt19937 random(seed);
  for (float& value : map.pixels) value = static_cast<float>(random() >> 8) / 8388608.0f;
  return map;
}

/// Noise and a sun of one texel, so many times the mean.
inline Image sun_map(int width, int height, float sun) {
  Image map = noise_map(width, height, 5);
  const float colour[3] = {1.0f, 0.9f, 0.7f};
  for (int c = 0; c < 3; ++c) map.at(width / 3, height / 4)[c] = sun * colour[c];
  return map;
}

/// Log-normal noise (median 1, standard deviation of the logarithm 1) and `lamps` coloured lamps of 2 x 2 texels, 100 to 1000 each.
inline Image lamp_map(int width, int height, unsigned seed, int lamps = 4) {
  Image map(width, height);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  for (float& value : map.pixels) value = std::exp(normal(random));
  for (int i = 0; i < lamps; ++i) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(width - 1));
    const int y = static_cast<int>(random() % static_cast<unsigned>(height - 1));
    const float strength = 100 * std::exp(2.3f * static_cast<float>(random() >> 8) / 16777216.0f);
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) map.at(x + k % 2, y + k / 2)[c] = strength * (c == i % 3 ? 1.0f : 0.7f);
  }
  return map;
}

}  // namespace welkin
