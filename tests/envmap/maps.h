#pragma once
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

}  // namespace welkin
