#include <gtest/gtest.h>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/built_in.h>

namespace welkin {
namespace {

std::shared_ptr<const EnvironmentData> white_light() {
  Image white(64, 32);
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
  IblOptions options;
  options.size = 32;
  options.irradiance_size = 16;
  return make_environment_data(std::move(white), options);
}

// A white environment lights every diffuse surface by E = pi: radiance is the albedo.
TEST(BasicTechniques, DiffuseSurfacesUnderAWhiteSkyShowTheirAlbedo) {
  const HeadlessContext context;
  {
    Renderer renderer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    Scene scene = make_built_in_scene("spheres");
    for (Material& material : scene.materials) {
      material = {};
      material.base_color = {0.25f, 0.5f, 0.75f};
    }
    renderer.set_technique(find_technique("irradiance-map"), {});
    renderer.set_camera(scene.cameras[0]);
    renderer.set_scene(scene);
    renderer.set_environment(white_light());
    renderer.resize(96, 64);
    renderer.draw();
    const Image picture = renderer.read_picture();
    int surface = 0;
    for (int i = 0; i < picture.width * picture.height; ++i) {
      const float* pixel = &picture.pixels[4 * static_cast<std::size_t>(i)];
      if (pixel[3] == 0) continue;
      ++surface;
      EXPECT_NEAR(pixel[0], 0.25f, 2e-4f);
      EXPECT_NEAR(pixel[1], 0.50f, 4e-4f);
      EXPECT_NEAR(pixel[2], 0.75f, 6e-4f);
    }
    EXPECT_GT(surface, 1000);
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace welkin
