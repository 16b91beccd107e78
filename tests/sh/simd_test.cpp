#include <welkin/parallel/simd.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <welkin/error.h>
#include <welkin/sh/batch_fft.h>
#include <welkin/sh/row_fft.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>

// Every kernel on every instruction set of this machine, against the plain FFT and against the set without vectors.

namespace welkin {
namespace {

class EverySimdTarget : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { choose_simd_target(GetParam()); }
  void TearDown() override { choose_simd_target(""); }
};

INSTANTIATE_TEST_SUITE_P(Machine, EverySimdTarget, testing::ValuesIn(simd_targets()),
                         [](const auto& of) { return of.param; });

std::vector<double> noise(std::size_t count, unsigned seed) {
  std::vector<double> values(count);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (double& value : values) value = normal(random);
  return values;
}

TEST(SimdTargets, EndWithOneForEveryMachine) {
  ASSERT_FALSE(simd_targets().empty());
  EXPECT_TRUE(simd_targets().back() == "SCALAR" || simd_targets().back() == "EMU128")
      << simd_targets().back();
  EXPECT_THROW(choose_simd_target("abacus"), Error);
}

// Lengths of every radix, of none (7, 74: one lane after the other), and 1.
TEST_P(EverySimdTarget, BatchFftEqualsRowFft) {
  for (int length : {1, 2, 3, 4, 5, 7, 8, 9, 12, 25, 30, 64, 74, 120, 2000})
    for (bool inverse : {false, true}) {
      BatchFft batch(length, inverse);
      RowFft single(length, inverse);
      const std::vector<double> values = noise(static_cast<std::size_t>(length) * 16, 3);
      for (int k = 0; k < length; ++k) std::copy_n(&values[k * 16], 16, batch.at(k));
      batch.transform();
      for (int lane = 0; lane < 8; ++lane) {
        std::vector<std::complex<double>> in(length), out(length);
        for (int k = 0; k < length; ++k) in[k] = {values[k * 16 + lane], values[k * 16 + 8 + lane]};
        single.transform(in.data(), out.data());
        for (int k = 0; k < length; ++k)
          ASSERT_LT(std::abs(out[k] - std::complex<double>(batch.at(k)[lane], batch.at(k)[8 + lane])),
                    1e-13 * length)  // rounding of values that grow like the square root of length
              << length << " lane " << lane << " k " << k;
      }
    }
}

// Orders with underflow at the poles, with a last step that is even or odd, and rows that do not fill the last vector.
TEST_P(EverySimdTarget, LegendreSumsEqualThoseWithoutVectors) {
  constexpr int degree = 301;
  const legendre::RowPairs rows(324);
  for (int channels : {1, 3, 4}) {
    const int parts = 2 * channels;
    legendre::OrderData data(degree, rows, parts);
    for (int m : {0, 1, 40, 150, 296, 300, 301}) {
      const std::size_t count = static_cast<std::size_t>(degree - m + 1) * parts;
      const std::vector<double> coefficients = noise(count, 5);
      std::vector<double> fast(count), slow(count);
      const auto both_ways = [&](std::vector<double>& back) {
        legendre::synthesize_order(m, rows, coefficients.data(), data);
        const std::vector<double> values(data.at(m, 0, 0), data.at(m, 0, 0) + 2 * parts * rows.padded);
        legendre::analyze_order(m, rows, data, back.data());
        return values;
      };
      const std::vector<double> fast_values = both_ways(fast);
      choose_simd_target(simd_targets().back());
      const std::vector<double> slow_values = both_ways(slow);
      choose_simd_target(GetParam());
      for (std::size_t i = 0; i < slow_values.size(); ++i)
        ASSERT_NEAR(fast_values[i], slow_values[i], 1e-9)
            << m;  // rounding, which the recurrence magnifies at the poles
      for (std::size_t i = 0; i < count; ++i) ASSERT_NEAR(fast[i], slow[i], 1e-9 * rows.pairs) << m;
    }
  }
}

// From a map to its spectrum and back to values, against the sum over all functions.
TEST_P(EverySimdTarget, TransformEqualsTheSlowSum) {
  Image map(30, 14);
  std::mt19937 random(11);
  for (float& value : map.pixels) value = static_cast<float>(random() % 1000u) / 500.0f;
  const Spectrum spectrum = analyze(map, {.max_degree = 20});
  for (int rows : {22, 60}) {  // the second is finer than the degree needs
    const SphereGrid grid = synthesize(spectrum, rows, 44);
    for (int row = 0; row < rows; row += 3) {
      const double theta = std::numbers::pi * (row + 0.5) / rows;
      const auto expected =
          evaluate(spectrum, {-std::sin(theta) * std::cos(std::numbers::pi / 44), std::cos(theta),
                              -std::sin(theta) * std::sin(std::numbers::pi / 44)});
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(grid.at(row, 0)[c], expected[c], 1e-6);  // floats below 4
    }
  }
}

}  // namespace
}  // namespace welkin
