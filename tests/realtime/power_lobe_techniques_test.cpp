#include <gtest/gtest.h>

#include "sphere_picture.h"

#include <numbers>
#include <string>

#include <welkin/brdf/fresnel_blend.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/brdf/models.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/techniques/power_lobe_maps.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

Material phong(float exponent) {
  Material material;
  material.model = MaterialModel::phong;
  material.compensated = false;
  material.base_color = {0.5f, 0.75f, 1};
  material.exponent = exponent;
  return material;
}

Material lafortune(float cx, float cy, float cz, float exponent) {
  Material material = phong(exponent);
  material.model = MaterialModel::lafortune;
  material.lafortune_c = {cx, cy, cz};
  return material;
}

constexpr std::array<double, 3> colour = {0.5, 0.75, 1};

// (N + 1) / (2 pi) cos^N about the normal itself: the integral of cos^(N+1) is (N + 1) / (N + 2), its mean cosine
// (N + 2) / (N + 3). About an axis in the surface, N = 1: (1 / pi) times the integral of l_x l_z over the quarter, 2 / 3.
TEST(MomentLobe, HasTheMomentsOfClosedForms) {
  for (const double n : {0.0, 1.0, 7.0, 100.0, 4096.0}) {
    const MomentLobe lobe = moment_lobe(1, n);
    EXPECT_NEAR(lobe.energy, (n + 1) / (n + 2), 1e-4) << n;
    EXPECT_NEAR(lobe.mean_cosine, (n + 2) / (n + 3), 1e-4) << n;
  }
  EXPECT_NEAR(moment_lobe(0, 1).energy, 2 / (3 * std::numbers::pi), 1e-4);
  EXPECT_NEAR(moment_lobe(0, 1).lean, 1, 1e-3);  // x and z are alike: the axis leans by 45 degrees
}

// Halves (5e-4), and the mesh's normals: 3e-4 / n.v.
TEST(PowerLobes, AConstantSkyIsReflectedAsByTheIntegral) {
  const HeadlessContext context;
  const auto light = small_maps(constant_environment(1, 1, 1));
  const auto pixels = sphere_pixels({}, 3, 0.3);
  SpherePainter painter("prefiltered-phong");
  for (const float exponent : {1.0f, 10.0f, 300.0f}) {
    const auto truth = sphere_truth(light->radiance, make_phong_brdf(exponent, colour), pixels);
    EXPECT_LT(sphere_error(painter.draw(phong(exponent), light), pixels, truth).largest, 3e-3) << exponent;
  }
}

Image gradient() {
  Image map(32, 16);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec3 d = equirect_direction({(x + 0.5) / 32, (y + 0.5) / 16});
      const double value[3] = {1 + 0.8 * d.x, 1 + 0.9 * d.y, 1 - 0.5 * d.z + 0.5 * d.x};
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>(value[c]);
    }
  return map;
}

// Nothing above degree 1: the lobe with the right energy, axis and width is exact but for the
// bilinear look-up: the gradient over texels of the coarse levels, 8 of which span 1 / sqrt(N), about 1 %.
TEST(PowerLobes, AGradientIsReflectedAsByTheIntegral) {
  const HeadlessContext context;
  const auto light = small_maps(gradient());
  const SphereView view{{0.5f, 0.4f, 1}};
  const auto pixels = sphere_pixels(view, 4, 0.2);
  SpherePainter phongs("prefiltered-phong"), lafortunes("lafortune");
  for (const float exponent : {1.0f, 5.0f, 500.0f}) {
    const auto truth = sphere_truth(light->radiance, make_phong_brdf(exponent, colour), pixels);
    for (SpherePainter* painter : {&phongs, &lafortunes})
      EXPECT_LT(sphere_error(painter->draw(phong(exponent), light, view), pixels, truth).largest, 1.5e-2)
          << exponent;
  }
}

TEST(PowerLobes, MomentsAreCloserToTheIntegralThanTheCosineOutside) {
  const HeadlessContext context;
  const Image radiance = small_environment(17);
  const auto light = small_maps(radiance);
  const SphereView view{{1, 0.3f, 0.2f}};
  const auto pixels = sphere_pixels(view, 4, 0.1);
  SpherePainter moments("prefiltered-phong"), published("prefiltered-phong:lobe=published");
  for (const float exponent : {1.0f, 4.0f, 30.0f, 200.0f}) {
    const auto truth = sphere_truth(radiance, make_phong_brdf(exponent, colour), pixels);
    const double ours = sphere_error(moments.draw(phong(exponent), light, view), pixels, truth).mean;
    const double theirs = sphere_error(published.draw(phong(exponent), light, view), pixels, truth).mean;
    EXPECT_LT(ours, 0.06) << exponent;
    EXPECT_LT(ours, theirs) << exponent;
  }
}

// As published it is what reflect(LafortuneStack) is in C++.
TEST(Lafortune, AsPublishedIsWhatTheLibraryComputes) {
  const HeadlessContext context;
  const Image radiance = small_environment(17);
  const auto light = small_maps(radiance);
  const LafortuneStack stack = prepare_lafortune_stack(radiance, {1024, 256});
  const SphereView view{{0.2f, 0.3f, 1}};
  const auto pixels = sphere_pixels(view, 4, 0.3);
  SpherePainter painter("lafortune:lobe=published");
  const std::array<float, 3> weights[] = {{-1, -1, 1}, {-1, -1, 0.7f}, {-0.95f, -0.6f, 0.9f}};
  for (const auto& c : weights) {
    const LafortuneBrdf brdf{{}, {{c[0], c[1], c[2], 30, colour}}};
    std::vector<double> expected;
    for (const SpherePixel& pixel : pixels) {
      const Vec3 n = pixel.query.normal;
      const Vec3 tangent = normalized(Vec3{-n.z, 0, n.x});
      for (const double v : reflect(stack, brdf, TangentQuery{n, tangent, pixel.query.view}))
        expected.push_back(v);
    }
    const Image picture = painter.draw(lafortune(c[0], c[1], c[2], 30), light, view);
    EXPECT_LT(sphere_error(picture, pixels, expected).largest, 1e-2) << c[1] << " " << c[2];
  }
}

TEST(Lafortune, BentAndAnisotropicLobesAreNearTheIntegral) {
  const HeadlessContext context;
  const Image radiance = small_environment(17);
  const auto light = small_maps(radiance);
  const SphereView view{{0.2f, 0.3f, 1}};
  const auto pixels = sphere_pixels(view, 4, 0.15);
  std::vector<TangentQuery> queries;
  for (const SpherePixel& pixel : pixels) {
    const Vec3 n = pixel.query.normal;
    queries.push_back({n, normalized(Vec3{-n.z, 0, n.x}), pixel.query.view});
  }
  SpherePainter moments("lafortune"), published("lafortune:lobe=published");
  struct Case {
    float cx, cy, cz, exponent;
  };
  for (const Case& c : {Case{-1, -1, 0.7f, 20}, Case{-0.95f, -0.6f, 0.9f, 30}, Case{-1, -1, 1, 2}}) {
    const LafortuneBrdf brdf{{}, {{c.cx, c.cy, c.cz, c.exponent, colour}}};
    const auto truth = reflect_lafortune_brute_force(radiance, brdf, queries);
    const Material material = lafortune(c.cx, c.cy, c.cz, c.exponent);
    const double ours = sphere_error(moments.draw(material, light, view), pixels, truth).mean;
    const double theirs = sphere_error(published.draw(material, light, view), pixels, truth).mean;
    EXPECT_LT(ours, 0.07) << c.cy << " " << c.cz;
    EXPECT_LT(ours, theirs) << c.cy << " " << c.cz;
  }
}

// A white compensated lobe loses nothing under a constant sky.
TEST(PowerLobes, CompensatedMaterialsLoseNothing) {
  const HeadlessContext context;
  const auto light = small_maps(constant_environment(1, 1, 1));
  Material material = phong(5);
  material.compensated = true;
  const Image picture = draw_sphere("prefiltered-phong", material, light);
  for (const SpherePixel& pixel : sphere_pixels({}, 4, 0.1))
    EXPECT_NEAR(picture.at(pixel.x, pixel.y)[2], 1, 2e-3);
}

// The base is exact but for 1 - F at one angle; the coat of a mirror is a look-up.
TEST(FresnelBlend, ASmoothCoatUnderAConstantSkyAddsUpToTheLayers) {
  const HeadlessContext context;
  const auto light = small_maps(constant_environment(1, 1, 1));
  Material plastic;
  plastic.metallic = 0;
  plastic.perceptual_roughness = 0;
  plastic.base_color = {0.5f, 0.25f, 1};
  for (const char* technique : {"fresnel-blend", "fresnel-blend:fresnel=exact"}) {
    const Image picture = draw_sphere(technique, plastic, light);
    const auto pixels = sphere_pixels({}, 4, 0.1);
    for (const SpherePixel& pixel : pixels) {
      const double cosine = dot(pixel.query.normal, pixel.query.view);
      const FresnelLaw::Kind kind = technique == std::string("fresnel-blend") ? FresnelLaw::Kind::schlick
                                                                              : FresnelLaw::Kind::dielectric;
      FresnelLaw law;
      law.kind = kind;
      const double f = reflectance(law, cosine)[0];
      EXPECT_NEAR(picture.at(pixel.x, pixel.y)[0], f + (1 - f) * 0.5, 3e-3) << technique;
      EXPECT_NEAR(picture.at(pixel.x, pixel.y)[2], 1, 1e-3) << technique;
    }
  }
}

TEST(FresnelBlend, IsNearTheIntegralOfItsMaterial) {
  const HeadlessContext context;
  const Image radiance = small_environment(17);
  const auto light = small_maps(radiance);
  const auto pixels = sphere_pixels({}, 4, 0.1);
  FresnelBlendMaterial material;
  material.exponent = 60;
  const auto truth = sphere_truth(radiance, make_fresnel_blend_brdf(material), pixels);
  Material plastic;
  plastic.metallic = 0;
  plastic.base_color = {0.5f, 0.5f, 0.5f};
  plastic.perceptual_roughness = std::pow(1 / (2 * 60.0f + 1), 0.25f);
  const SphereError error = sphere_error(draw_sphere("fresnel-blend", plastic, light), pixels, truth);
  EXPECT_LT(error.mean, 0.1);
}

}  // namespace
}  // namespace welkin
