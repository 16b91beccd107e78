#include <welkin/envmap/methods/kernel_quantiles.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

// cos^N integrates in closed form: the share within u is 1 - (1 - u)^(N + 1).
TEST(KernelQuantiles, OfPhongAreThoseOfTheClosedForm) {
  for (double exponent : {1.0, 30.0, 5000.0}) {
    const KernelQuantiles quantiles(make_phong_kernel(exponent));
    for (double share : {0.0, 0.01, 0.3, 0.5, 0.9, 0.999}) {
      const double u = -std::expm1(std::log1p(-share) / (exponent + 1));
      // 2 % cells in angle, linear in u inside: the second difference, 0.04^2 / 8, of the share.
      EXPECT_NEAR(quantiles.share(u), share, 2e-4) << exponent;
      EXPECT_NEAR(quantiles.share(quantiles.one_minus_cos(share)), share, 1e-12) << exponent;
    }
  }
}

TEST(KernelQuantiles, FindThinTails) {
  const double exponent = 100;
  const KernelQuantiles quantiles(make_phong_kernel(exponent));
  for (double tail : {1e-2, 1e-6, 1e-12}) {
    const double angle = std::acos(std::pow(tail, 1 / (exponent + 1)));
    EXPECT_NEAR(quantiles.angle_with_tail(tail), angle, 0.01 * angle) << tail;  // half a cell of 2 %
  }
}

TEST(KernelQuantiles, KnowEveryKernelsEnd) {
  for (const ZonalKernel& kernel :
       {make_ggx_kernel(0.01), make_ggx_kernel(1), make_lambert_kernel(), make_gaussian_kernel(0.002)}) {
    const KernelQuantiles quantiles(kernel);
    EXPECT_EQ(quantiles.share(0), 0);
    EXPECT_NEAR(quantiles.share(2), 1, 1e-12);
    EXPECT_LE(quantiles.one_minus_cos(1), 2);
    EXPECT_LT(quantiles.one_minus_cos(0.3), quantiles.one_minus_cos(0.4));
  }
  EXPECT_LE(KernelQuantiles(make_ggx_kernel(0.3)).angle_with_tail(1e-9), std::numbers::pi / 2 + 1e-12);
}

}  // namespace
}  // namespace welkin
