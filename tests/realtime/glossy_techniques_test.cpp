#include <gtest/gtest.h>

#include "sphere_picture.h"

#include <welkin/brdf/models.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/realtime/gl/headless_context.h>

namespace welkin {
namespace {

Material metal(float perceptual_roughness, Rgb f0 = {1, 1, 1}) {
  Material material;
  material.model = MaterialModel::ggx;
  material.compensated = false;
  material.base_color = f0;
  material.perceptual_roughness = perceptual_roughness;
  return material;
}

// The weights are scaled to the DFG's: but for its interpolation (0.008 at most where n.v > 0.1) it is exact.
TEST(Stretched, AConstantSkyIsReflectedAsByTheIntegral) {
  const HeadlessContext context;
  const auto light = small_maps(constant_environment(1, 1, 1));
  SpherePainter painter("stretched");
  for (const float roughness : {0.3f, 0.6f, 0.9f}) {
    const auto pixels = sphere_pixels({}, 3, 0.1);
    const auto truth = sphere_truth(light->radiance, make_ggx_brdf(roughness * roughness, {1, 1, 1}), pixels);
    EXPECT_LT(sphere_error(painter.draw(metal(roughness), light), pixels, truth).largest, 1e-2) << roughness;
  }
}

// In GLSL it is what reflect(StretchedTaps) is in C++: tables in halves, cubes in halves.
TEST(Stretched, IsWhatTheLibraryComputes) {
  const HeadlessContext context;
  const Image radiance = small_environment(11);
  const auto light = small_maps(radiance);
  PrefilterOptions prefilter;
  prefilter.size = light->maps.specular.size();
  prefilter.levels = static_cast<int>(light->maps.specular.levels.size());
  const SphereView view{{0.3f, 0.4f, 1}};
  const auto pixels = sphere_pixels(view, 4, 0.3);
  SpherePainter painter("stretched");
  StretchedTaps expected = prepare_stretched_taps(radiance, {1, 1, 1}, 1, prefilter);
  for (const float roughness : {0.4f, 0.7f}) {
    expected.alpha = static_cast<double>(roughness) * roughness;
    std::vector<double> values;
    for (const SpherePixel& pixel : pixels)
      for (const double v : reflect(expected, pixel.query)) values.push_back(v);
    const SphereError error = sphere_error(painter.draw(metal(roughness), light, view), pixels, values);
    EXPECT_LT(error.mean, 2e-3) << roughness;
    EXPECT_LT(error.largest, 2e-2) << roughness;
  }
}

// docs/reflection.md: a third of the split sum's error or less from perceptual roughness 0.5 up, on a ball.
TEST(Stretched, IsCloserToTheIntegralThanTheSplitSum) {
  const HeadlessContext context;
  const Image radiance = small_environment(13);
  const auto light = small_maps(radiance);
  const SphereView view{{1, 0.3f, 0.2f}};
  const auto pixels = sphere_pixels(view, 4, 0.1);
  SpherePainter painter("stretched");
  for (const float roughness : {0.5f, 0.7f}) {
    const auto truth = sphere_truth(radiance, make_ggx_brdf(roughness * roughness, {1, 1, 1}), pixels);
    const double taps = sphere_error(painter.draw(metal(roughness), light, view), pixels, truth).mean;
    const double split =
        sphere_error(draw_sphere("prefiltered-ggx", metal(roughness), light, view), pixels, truth).mean;
    EXPECT_LT(taps, 0.06) << roughness;
    EXPECT_LT(taps, split / 2) << roughness;
  }
}

}  // namespace
}  // namespace welkin
