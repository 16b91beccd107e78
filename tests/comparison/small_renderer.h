#pragma once
#include <random>
#include <string>

#include <welkin/realtime/renderer.h>
#include <welkin/scene/built_in.h>

namespace welkin {

/// A smooth sky with some texels that are much brighter, other values on every run of the generator's seed.
inline Image small_sky(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.8f, 1.2f);
  Image map(64, 32);
  for (int y = 0; y < 32; ++y) {
    const float height = 1 - static_cast<float>(y) / 16;
    for (int x = 0; x < 64; ++x) {
      const float rgb[] = {0.4f + 0.2f * height, 0.5f + 0.3f * height, 0.6f + 0.45f * height};
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = uniform(random) * rgb[c];
    }
  }
  for (int x = 38; x < 42; ++x)
    for (int c = 0; c < 3; ++c) map.at(x, 8)[c] = 25;
  return map;
}

/// Maps of one sky, made once.
inline std::shared_ptr<const EnvironmentData> small_light() {
  static const std::shared_ptr<const EnvironmentData> light = [] {
    IblOptions options;
    options.size = 64;
    options.irradiance_size = 32;
    return make_environment_data(small_sky(7), options);
  }();
  return light;
}

/// A renderer of a built-in scene in small_light(). Needs a context.
struct SmallRenderer {
  Renderer renderer{RendererOptions{TexelFormat::rgba32f, TexelFormat::rgba32f}};

  SmallRenderer(int width, int height, const std::string& scene_name = "spheres") {
    renderer.set_technique(techniques()[0], initial_values(techniques()[0]));
    Scene scene = make_built_in_scene(scene_name);
    renderer.set_camera(scene.cameras[0]);
    renderer.set_scene(std::move(scene));
    renderer.set_environment(small_light());
    renderer.resize(width, height);
  }
};

}  // namespace welkin
