#include <welkin/envmap/patch_quadrature.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

// The midpoint rule on a fine grid, in double: slow and obvious. Converges as 1/n^2; two sizes are extrapolated.
double midpoint(const ZonalKernel& kernel, Vec3 direction, const SpherePatch& p, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double theta = p.theta0 + (p.theta1 - p.theta0) * (i + 0.5) / n,
                   phi = p.phi0 + (p.phi1 - p.phi0) * (j + 0.5) / n;
      const Vec3 d =
          Vec3{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)} - direction;
      sum += std::sin(theta) * evaluate(kernel, 0.5 * dot(d, d));
    }
  return sum * (p.theta1 - p.theta0) * (p.phi1 - p.phi0) / n / n;
}

double reference(const ZonalKernel& kernel, Vec3 direction, const SpherePatch& patch) {
  const double coarse = midpoint(kernel, direction, patch, 400),
               fine = midpoint(kernel, direction, patch, 800);
  return fine + (fine - coarse) / 3;
}

// Texels of a 64 x 32 map, 0.1 rad wide, against kernels from far wider to far narrower than them; the axis inside, on
// a corner, beside and far from the texel, and at a pole.
TEST(PatchQuadrature, IsRightForWideAndNarrowKernels) {
  const SpherePatch patches[] = {equirect_patch(64, 32, 20, 12), equirect_patch(64, 32, 5, 0)};
  for (const SpherePatch& patch : patches)
    for (const ZonalKernel& kernel : {make_ggx_kernel(0.5), make_ggx_kernel(0.05), make_ggx_kernel(0.005),
                                      make_phong_kernel(300), make_gaussian_kernel(0.02)})
      for (const auto& [a, b] : {std::pair{0.5, 0.5}, {0.0, 0.0}, {0.9, 0.2}, {1.4, 0.5}, {6.0, 3.0}}) {
        const double theta = patch.theta0 + a * (patch.theta1 - patch.theta0),
                     phi = patch.phi0 + b * (patch.phi1 - patch.phi0);
        const Vec3 axis{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
        const double expected = reference(kernel, axis, patch), largest = evaluate(kernel, 0.0) * 0.01;
        // 1e-7 of the integral as the header says, with the reference's own error and values of no weight allowed for.
        EXPECT_NEAR(integrate_kernel(kernel, axis, patch), expected, 1e-6 * expected + 1e-9 * largest)
            << describe(kernel) << " at " << a << " " << b;
      }
}

// A texel across the kernel's end at 90 degrees, where a plain rule is off by the square of the texel size: the axis at
// many angles to it, at the poles and the equator, against the midpoint rule on 600 x 600 points.
TEST(PatchQuadrature, IsRightAcrossTheEndOfTheKernel) {
  for (const SpherePatch& patch : {equirect_patch(64, 32, 20, 12), equirect_patch(64, 32, 0, 0),
                                   equirect_patch(64, 32, 63, 16), equirect_patch(64, 32, 7, 29)})
    for (int i = 0; i < 12; ++i) {
      const double theta = patch.theta0 + (0.1 + 0.07 * i) * (patch.theta1 - patch.theta0);
      const double phi = patch.phi0 + (0.9 - 0.06 * i) * (patch.phi1 - patch.phi0);
      const Vec3 inside{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      const Vec3 helper = normalized({std::sin(1.0 + i), std::cos(2.0 * i), 0.3});
      const Vec3 axis = normalized(cross(inside, helper));  // at 90 degrees to a point of the patch
      for (const ZonalKernel& kernel : {make_lambert_kernel(), make_ggx_kernel(0.4), make_phong_kernel(1)}) {
        const double expected = midpoint(kernel, axis, patch, 600);
        EXPECT_NEAR(integrate_kernel(kernel, axis, patch), expected, 1e-3 * expected + 2e-8)
            << describe(kernel) << " " << i;  // 2e-8: 1e-4 of a typical texel, for slivers in a corner
      }
    }
}

TEST(PatchQuadrature, CoreAndWindowMakeTheKernel) {
  const ZonalKernel kernel = make_ggx_kernel(0.02);
  const SpherePatch patch = equirect_patch(64, 32, 20, 12);
  const Vec3 axis = equirect_direction({20.2 / 64, 12.7 / 32});
  // A window far wider than the patch changes nothing; one that ends before it leaves nothing.
  EXPECT_NEAR(integrate_kernel(kernel, axis, patch, 3.0), integrate_kernel(kernel, axis, patch), 1e-6);
  EXPECT_EQ(integrate_kernel(kernel, -axis, patch, 0.5), 0);
}

TEST(PatchQuadrature, PatchesOfAMapCoverTheSphere) {
  const ZonalKernel kernel = make_ggx_kernel(0.1);
  const Vec3 axis = normalized({0.3, 0.9, -0.2});
  double sum = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) sum += integrate_kernel(kernel, axis, equirect_patch(32, 16, x, y));
  EXPECT_NEAR(sum, 1, 1e-5);  // the kink at 90 degrees costs some patches more than 1e-6
}

}  // namespace
}  // namespace welkin
