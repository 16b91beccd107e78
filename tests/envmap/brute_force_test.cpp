#include <welkin/envmap/brute_force.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maps.h"

#include <welkin/envmap/patch_quadrature.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

const std::vector<ZonalKernel>& kernels() {
  static const std::vector<ZonalKernel> all{make_ggx_kernel(0.02), make_ggx_kernel(0.4),
                                            make_lambert_kernel(), make_phong_kernel(80)};
  return all;
}

TEST(BruteForce, LeavesAConstantAsItIs) {
  const Image map = constant_map(96, 48, 3);
  std::vector<Vec3> directions = sphere_points(10);
  directions.insert(directions.end(), {{0, 1, 0}, {0, -1, 0}, {-1, 0, 0}, {1, 0, 0}});
  for (double value : filter_brute_force(map, directions, kernels()))
    EXPECT_NEAR(value, 3, 1e-4);  // 3e-5 relative: the kink at 90 degrees on texels of 0.07 rad
}

// One lit texel: the answer is its radiance times the kernel's integral over it, whatever the rest of the sum does.
TEST(BruteForce, OfOneTexelIsItsPatchIntegral) {
  Image map(64, 32);
  map.at(40, 9)[1] = 7;
  for (const Vec3& d : {equirect_direction({40.3 / 64, 9.9 / 32}), equirect_direction({39.5 / 64, 9.5 / 32}),
                        equirect_direction({0.1, 0.8})}) {
    const auto values = filter_brute_force(map, std::span(&d, 1), kernels());
    for (std::size_t k = 0; k < kernels().size(); ++k) {
      const double expected = 7 * integrate_kernel(kernels()[k], d, equirect_patch(64, 32, 40, 9));
      EXPECT_NEAR(values[3 * k + 1], expected, 1e-5 * expected + 1e-12);
      EXPECT_EQ(values[3 * k], 0);
    }
  }
}

// A ramp L = 1 + w . d filtered by any kernel is 1 + k_1 w . n (Funk-Hecke with degree 1).
TEST(BruteForce, OfARampIsItsDegreeOne) {
  const Vec3 w{0.3, -0.5, 0.6};
  Image map(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x)
      for (int c = 0; c < 3; ++c)
        map.at(x, y)[c] =
            static_cast<float>(1 + dot(w, equirect_direction({(x + 0.5) / 512, (y + 0.5) / 256})));
  const std::vector<Vec3> directions = sphere_points(6);
  const auto values = filter_brute_force(map, directions, kernels());
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t k = 0; k < kernels().size(); ++k)
      EXPECT_NEAR(values[(i * kernels().size() + k) * 3],
                  1 + legendre_coefficients(kernels()[k], 1)[1] * dot(w, directions[i]),
                  3e-5);  // texel size squared / 24
}

TEST(BruteForce, IsBitIdenticalOnAnyNumberOfThreads) {
  const Image map = noise_map(64, 32, 1);
  const std::vector<Vec3> directions = sphere_points(9);
  set_thread_count(1);
  const auto once = filter_brute_force(map, directions, kernels());
  set_thread_count(8);
  EXPECT_EQ(filter_brute_force(map, directions, kernels()), once);
  set_thread_count(0);
}

}  // namespace
}  // namespace welkin
