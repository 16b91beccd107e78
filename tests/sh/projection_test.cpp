#include <welkin/sh/projection.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

template <class Function>
Image map_of(int width, int height, Function&& radiance) {
  Image map(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        map.at(x, y)[c] =
            static_cast<float>(radiance(equirect_direction({(x + 0.5) / width, (y + 0.5) / height})));
  return map;
}

// L = 1 gives sqrt(4 pi) in degree 0 and nothing else; its irradiance is pi everywhere.
TEST(Projection, OfAConstantGivesIrradiancePi) {
  const ShCoefficients radiance = project_equirect(map_of(64, 32, [](Vec3) { return 1.0; }), 4);
  EXPECT_NEAR(radiance.values[0], std::sqrt(4 * pi), 1e-12);
  const ShCoefficients irradiance = convolve(radiance, cosine_lobe(4));
  double value[3];
  evaluate(irradiance, normalized({1, 2, 3}), value);
  EXPECT_NEAR(value[1], pi, 1e-9);
}

// L = 1 + w . d: the linear part lies along w in the world frame, so axes and signs cannot be mixed up.
// Its irradiance is pi + (2 pi/3) w . n.
TEST(Projection, OfARampPointsAlongIt) {
  const Vec3 w{0.2, 0.5, -0.7};
  const Image map = map_of(512, 256, [&](Vec3 d) { return 1 + dot(w, d); });
  for (const ShCoefficients& radiance : {project_equirect(map, 3), project_equirect_texel_centres(map, 3)}) {
    const double scale = std::sqrt(4 * pi / 3);
    EXPECT_NEAR(radiance.values[sh_index(1, 1) * 3], scale * w.x, 1e-4);  // texel size squared over 24
    EXPECT_NEAR(radiance.values[sh_index(1, -1) * 3], scale * w.y, 1e-4);
    EXPECT_NEAR(radiance.values[sh_index(1, 0) * 3], scale * w.z, 1e-4);
    double value[3];
    const Vec3 n = normalized({-1, 0.4, 0.3});
    evaluate(convolve(radiance, cosine_lobe(3)), n, value);
    EXPECT_NEAR(value[2], pi + 2 * pi / 3 * dot(w, n), 2e-4);
  }
}

// The texel-centre sum must converge to the exact one with the square of the texel size.
TEST(Projection, TexelCentresConvergeToPatches) {
  double errors[2];
  for (int i = 0; i < 2; ++i) {
    const int height = 32 << i;
    Image map(2 * height, height);
    for (std::size_t k = 0; k < map.pixels.size(); ++k)
      map.pixels[k] = static_cast<float>((k * 7919) % 101) / 50;
    const ShCoefficients exact = project_equirect(map, 8), centres = project_equirect_texel_centres(map, 8);
    errors[i] = 0;
    for (std::size_t k = 0; k < exact.values.size(); ++k)
      errors[i] = std::max(errors[i], std::abs(exact.values[k] - centres.values[k]));
  }
  EXPECT_LT(errors[0], 5e-3);
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_GT(errors[1], 0);
}

TEST(Projection, RefusesDegreesOutOfRange) {
  const Image map(8, 4);
  EXPECT_THROW(project_equirect(map, -1), Error);
  EXPECT_THROW(project_equirect(map, max_projection_degree + 1), Error);
}

}  // namespace
}  // namespace welkin
