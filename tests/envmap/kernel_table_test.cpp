#include <welkin/envmap/kernel_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/envmap/maps.h>
#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/zonal_kernel.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

template <class Function>
KernelTable sampled(int knots, double end, Function&& function) {
  std::vector<double> angles, values;
  for (int i = 0; i < knots; ++i) {
    angles.push_back(end * i / (knots - 1));
    values.push_back(function(angles.back()));
  }
  return make_kernel_table(angles, values);
}

TEST(KernelTable, PassesThroughItsValuesAndNeverOvershoots) {
  const std::vector<double> angles{0, 0.1, 0.2, 0.5, 0.6, 1.5}, values{1, 1, 0.3, 0, 0, 2};
  const KernelTable table = make_kernel_table(angles, values);
  for (std::size_t i = 0; i < angles.size(); ++i) EXPECT_NEAR(table.evaluate(angles[i]), values[i], 1e-14);
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double low = std::min(values[i - 1], values[i]), high = std::max(values[i - 1], values[i]);
    for (double t = 0.01; t < 1; t += 0.01) {
      const double value = table.evaluate(angles[i - 1] + t * (angles[i] - angles[i - 1]));
      EXPECT_GE(value, low - 1e-14);
      EXPECT_LE(value, high + 1e-14);
    }
  }
  EXPECT_EQ(table.evaluate(1.50001), 0);
}

// The integral by Gauss nodes between knots, where the table is a cubic: exact but for the sine.
TEST(KernelTable, KernelsOfTablesIntegrateToOne) {
  const KernelTable table = make_kernel_table(std::vector<double>{0, 0.02, 0.3, 1.1, 2.5},
                                              std::vector<double>{3, 2.5, 0, 0.7, 0.1});
  const ZonalKernel kernel = make_table_kernel(table);
  const QuadratureRule rule = gauss_legendre(24);
  double sum = 0, cosine_sum = 0;
  for (std::size_t k = 1; k < table.angles.size(); ++k) {
    const double from = table.angles[k - 1], to = table.angles[k];
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double theta = 0.5 * (from + to) + 0.5 * (to - from) * rule.nodes[i];
      const double part = 0.5 * (to - from) * rule.weights[i] * 2 * pi * std::sin(theta) *
                          evaluate(kernel, 1 - std::cos(theta));
      sum += part;
      cosine_sum += part * std::cos(theta);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(legendre_coefficients(kernel, 3)[1], cosine_sum, 1e-11);
}

TEST(KernelTable, ATableOfAGaussianIsTheGaussian) {
  const ZonalKernel gaussian = make_gaussian_kernel(0.2);
  const ZonalKernel table =
      make_table_kernel(sampled(400, pi, [](double theta) { return 7 * std::exp(-theta * theta / 0.08); }));
  const auto a = legendre_coefficients(gaussian, 30), b = legendre_coefficients(table, 30);
  for (int l = 0; l <= 30; ++l) EXPECT_NEAR(a[l], b[l], 2e-5);  // h^2 f'' of the slopes, h = pi / 400
  EXPECT_NEAR(angular_width(table), 0.2, 0.01);
}

// A lobe that ends with a kink elsewhere than at 90 degrees, filtered in frequency against the sum over texels.
TEST(KernelTable, FiltersLikeAnyOtherKernel) {
  const Image map = sun_map(64, 32, 3000);
  const ZonalKernel kernel = make_table_kernel(make_kernel_table(std::vector<double>{0, 0.2, 0.4, 0.8, 1.2},
                                                                 std::vector<double>{1, 0.8, 0.4, 0.5, 0}));
  const FilterTarget target{kernel, 4};
  const Cube cube = filter_environment(map, std::span(&target, 1)).front();
  std::vector<Vec3> directions;
  for (int face = 0; face < 6; ++face) directions.push_back(cube_texel_direction(4, face, 1, 2));
  const auto truth = filter_brute_force(map, directions, std::span(&kernel, 1));
  for (int face = 0; face < 6; ++face)  // 3e-4 of the mean is the filter's default tolerance
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(cube.at(face, 1, 2)[c], truth[3 * face + c], 1e-3);
}

TEST(KernelTable, ReadsText) {
  const KernelTable table = parse_kernel_table("# angle value\n0, 1\n 45;0.5 # half\r\n\n90\t0", "lobe.csv");
  ASSERT_EQ(table.angles.size(), 3u);
  EXPECT_NEAR(table.angles[1], pi / 4, 1e-14);
  EXPECT_EQ(table.values, (std::vector<double>{1, 0.5, 0}));
}

std::string complaint(const char* text) {
  try {
    parse_kernel_table(text, "lobe.csv");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Each of these would be NaN, infinite or as good as nothing once normalised, or be searched for with texels' worth of
// nodes that all miss it.
TEST(KernelTable, RefusesWhatNumbersCannotCarry) {
  const std::string narrow = "lobe.csv: the kernel of this table is narrower than 0.0001 radians";
  EXPECT_EQ(complaint("0 1\n0.005 1\n0.0051 0\n"), narrow);
  EXPECT_EQ(complaint("0 0\n45 0\n45.0000001 1\n45.0000002 0\n"), narrow);
  EXPECT_EQ(complaint("0 0\n179.999999 0\n180 1\n"), narrow);
  EXPECT_EQ(complaint("0 1e308\n90 0\n"), "lobe.csv: the values of a kernel table must lie in [0, 1e30]");
  EXPECT_NE(complaint("0 1\n1e-310 0\n90 0\n"), "");
  EXPECT_EQ(complaint("0 1e30\n90 1e-30\n91 0\n"), "");
  EXPECT_EQ(complaint("0 1\n30 1\n30.0000001 0\n"), "");  // a cap is not narrow, steep as its end is
}

// A disc has no slope, from which a width could be read.
TEST(KernelTable, ADiscIsNoWiderThanItself) {
  const ZonalKernel disc =
      make_table_kernel(make_kernel_table(std::vector<double>{0, 0.001}, std::vector<double>{1, 1}));
  EXPECT_DOUBLE_EQ(angular_width(disc), 0.001);
}

TEST(KernelTable, NamesWhatIsWrong) {
  EXPECT_EQ(complaint("0 1\n10\n"), "lobe.csv, line 2: the angle has no value beside it");
  EXPECT_EQ(complaint("0 1\nten 2\n"), "lobe.csv, line 2: expected an angle in degrees and a value");
  EXPECT_EQ(complaint("0 1\n10 2 3\n"), "lobe.csv, line 2: more than an angle and a value");
  EXPECT_EQ(complaint("0 1\n181 2\n"), "lobe.csv, line 2: the angle is above 180 degrees");
  EXPECT_EQ(complaint(""), "lobe.csv: a kernel table needs 2 to 100000 lines, not 0");
  EXPECT_EQ(complaint("0 0\n10 0\n"), "lobe.csv: a kernel table must not be all zero");
  EXPECT_EQ(complaint("0 1\n10 nan\n"), "lobe.csv: the values of a kernel table must lie in [0, 1e30]");
  EXPECT_EQ(complaint("0 1\n10 -1\n"), "lobe.csv: the values of a kernel table must lie in [0, 1e30]");
  EXPECT_EQ(complaint("0 1\n10 1\n"),
            "lobe.csv: the last value must be 0 (or stand at 180 degrees): a lobe with a hard edge cannot be "
            "integrated well");
  EXPECT_EQ(complaint("0 1\n180 1\n"), "");
  for (const char* unordered : {"5 1\n10 1\n", "0 1\n20 1\n10 1\n", "0 1\nnan 1\n", "0 1\n0 2\n"})
    EXPECT_NE(complaint(unordered), "") << unordered;
}

}  // namespace
}  // namespace welkin
