#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <string>

#include <welkin/brdf/merl.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

std::string refusal(const std::vector<std::uint8_t>& bytes) {
  try {
    read_merl(bytes, "file.binary");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Merl, BytesAreThoseOfTheLayout) {
  MerlTable table{{2, 3, 4}, {}};
  for (std::size_t i = 0; i < 3 * 24; ++i) table.values.push_back(static_cast<float>(i) / 8);
  const std::vector<std::uint8_t> bytes = encode_merl(table);
  ASSERT_EQ(bytes.size(), 12 + 72 * 8u);
  std::int32_t dimensions[3];
  std::memcpy(dimensions, bytes.data(), 12);
  EXPECT_EQ(dimensions[0], 2);
  EXPECT_EQ(dimensions[1], 3);
  EXPECT_EQ(dimensions[2], 4);
  double value;
  std::memcpy(&value, bytes.data() + 12 + 8 * 25, 8);  // green, cell 1
  EXPECT_NEAR(value, 25.0 / 8 * 1500 / 1.15, 1e-9);
  EXPECT_EQ(read_merl(bytes, "").values, table.values);  // scaling there and back rounds to the same floats
}

TEST(Merl, BadFilesGetOneClearLine) {
  EXPECT_EQ(refusal({1, 2, 3}), "file.binary: 3 bytes are too few for a MERL file");
  std::vector<std::uint8_t> bytes = encode_merl(tabulate_merl(make_lambert_brdf({1, 1, 1}), {2, 2, 2}));
  std::vector<std::uint8_t> other = bytes;
  other.pop_back();
  EXPECT_EQ(refusal(other), "file.binary: 203 bytes, where a MERL file of 2 x 2 x 2 has 204");
  other = bytes;
  other[3] = 0x80;  // a negative dimension
  EXPECT_NE(refusal(other).find("are no dimensions"), std::string::npos);
  other = bytes;
  const double bad = std::nan("");
  std::memcpy(other.data() + 12 + 8 * 9, &bad, 8);
  EXPECT_EQ(refusal(other), "file.binary: number 1 of the green plane is not finite or beyond 1e30");
}

// The full shape, written, read and looked up at random. The table is linear between cells: the error is of second order
// in a cell of theta_diff, 1 degree, where the BRDF changes with the cosine at 84 degrees (0.1): Ward's goes as cos^-2, so
// 6 (0.0175 / 0.1)^2 / 8 = 0.02.
double table_error(const IsotropicBrdf& brdf, double smallest_cosine) {
  const IsotropicBrdf back = make_merl_brdf(read_merl(encode_merl(tabulate_merl(brdf)), "x"), "x");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double l = smallest_cosine + (1 - smallest_cosine) * uniform(random);
    const double v = smallest_cosine + (1 - smallest_cosine) * uniform(random);
    const double azimuth = i % 2 ? pi * uniform(random) : pi - 0.2 * uniform(random);
    const double truth = brdf.value(l, v, azimuth)[1], peak = brdf.value(v, v, pi)[1];
    worst = std::max(worst, std::abs(back.value(l, v, azimuth)[1] - truth) / peak);
  }
  return worst;
}

TEST(Merl, TabulatedBrdfsComeBack) {
  EXPECT_LT(table_error(make_lambert_brdf({0.2, 0.5, 0.8}), 0.02),
            1e-6);  // floats; invalid cells take no part
  EXPECT_LT(table_error(make_ggx_brdf(0.2, {1, 1, 1}), 0.1), 0.02);
  EXPECT_LT(table_error(make_ward_brdf(0.2), 0.1), 0.02);
}

TEST(Merl, LookUpIsReciprocalAndPeriodic) {
  MerlTable table{{6, 6, 9}, {}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t i = 0; i < 3 * table.shape.cells(); ++i)
    table.values.push_back(static_cast<float>(uniform(random) - 0.2));  // a fifth is invalid
  const IsotropicBrdf brdf = make_merl_brdf(table, "noise");
  for (int i = 0; i < 500; ++i) {
    const double l = 0.02 + 0.98 * uniform(random), v = 0.02 + 0.98 * uniform(random),
                 a = pi * uniform(random);
    const auto forth = brdf.value(l, v, a), back = brdf.value(v, l, a);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(forth[c], back[c], 1e-9);  // rounding of the angles, times the slope between cells
      EXPECT_GE(forth[c], 0);
    }
  }
}

TEST(Merl, InvalidCellsTakeNoPart) {
  MerlTable table{{1, 1, 1}, {-1, 2, 3}};
  const auto value = make_merl_brdf(table, "x").value(0.5, 0.7, 1);
  EXPECT_EQ(value[0], 0);  // nothing valid
  EXPECT_NEAR(value[1], 2, 1e-6);
  MerlTable two{{2, 1, 1}, {-1, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}};
  EXPECT_NEAR(make_merl_brdf(two, "x").value(0.8, 0.8, 0)[0], 0.5,
              1e-6);  // not darkened by its invalid neighbour
}

TEST(Merl, WidthFollowsThePeak) {
  for (double alpha : {0.1, 0.3}) {
    // GGX falls to half of its peak where tan = 0.64 alpha; twice that, up to a cell (0.024) and the growth of V.
    const double width = make_merl_brdf(tabulate_merl(make_ggx_brdf(alpha, {1, 1, 1})), "x").angular_width;
    EXPECT_NEAR(width, 2 * std::atan(0.6436 * alpha), 0.06);
  }
}

}  // namespace
}  // namespace welkin
