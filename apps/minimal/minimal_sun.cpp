// The sun as a light: take it out of an environment, and keep nine coefficients without negative irradiance for the rest.
// Usage: minimal_sun [INPUT]
#include <welkin/envmap/environment.h>
#include <welkin/envmap/lights.h>
#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/forms/document.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/projection.h>

#include <cstdio>
#include <numbers>

int main(int argc, char** argv) try {
  const welkin::Environment environment =
      welkin::load_environment(argc > 1 ? argv[1] : "sky:day,elevation=20,size=512x256");

  // map = residual + lights; with max_lights = 2 and a larger max_angular_radius its glow becomes a second light.
  const welkin::ExtractedLights extracted = welkin::extract_lights(environment.radiance, {.max_lights = 1});
  for (const welkin::DirectionalLight& light : extracted.lights)
    std::printf("sun towards (%.4f, %.4f, %.4f): irradiance %.4g %.4g %.4g, radius %.2f degrees\n",
                light.direction.x, light.direction.y, light.direction.z, light.irradiance[0],
                light.irradiance[1], light.irradiance[2], light.angular_radius * 180 / std::numbers::pi);

  const welkin::ShCoefficients radiance = welkin::project_equirect(extracted.residual, 2);
  const welkin::ShCoefficients irradiance =
      welkin::nonnegative_fit(welkin::convolve(radiance, welkin::cosine_lobe(2)));

  // What a surface gets: the coefficients for the sky, the lights in closed form.
  const welkin::Vec3 normal{0, 1, 0};
  double e[3];
  welkin::evaluate(irradiance, normal, e);
  for (const welkin::DirectionalLight& light : extracted.lights)
    for (int c = 0; c < 3; ++c) e[c] += welkin::directional_irradiance(light, normal)[c];
  std::printf("irradiance of level ground: %.4g %.4g %.4g\n", e[0], e[1], e[2]);

  // As an engine reads it, with the sun in a comment.
  welkin::ShDocument document{irradiance, welkin::ShQuantity::irradiance, environment.source};
  for (const welkin::DirectionalLight& light : extracted.lights)
    document.lights.push_back({light.direction, light.irradiance, light.angular_radius});
  std::fputs(welkin::write_sh(document, welkin::ShForm::glsl).c_str(), stdout);
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_sun: %s\n", error.what());
  return 1;
}
