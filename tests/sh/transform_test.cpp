#include <welkin/sh/transform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/basis.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;

Image random_map(int width, int height, unsigned seed, int channels = 3) {
  Image map(width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (float& value : map.pixels) value = uniform(random);
  return map;
}

// a_lm of the function of patches by the definition: for each texel, 16 x 16 Gauss-Legendre nodes, times the
// conjugate basis function from evaluate_sh_basis (whose pole is z: the map's (x, y, z) becomes (x, z, y)).
Spectrum analyze_slowly(const Image& map, int degree) {
  Spectrum spectrum(degree, map.channels);
  const QuadratureRule rule = gauss_legendre(16);
  std::vector<double> y(sh_count(degree));
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column)
      for (int a = 0; a < 16; ++a)
        for (int b = 0; b < 16; ++b) {
          const Vec3 d = equirect_direction({(column + 0.5 + 0.5 * rule.nodes[a]) / map.width,
                                             (row + 0.5 + 0.5 * rule.nodes[b]) / map.height});
          evaluate_sh_basis({d.x, d.z, d.y}, degree, y);
          const double sin_theta = std::hypot(d.x, d.z);
          const double weight = 0.25 * rule.weights[a] * rule.weights[b] * sin_theta * 2 * std::numbers::pi *
                                std::numbers::pi / (map.width * map.height);
          for (int m = 0; m <= degree; ++m)
            for (int l = m; l <= degree; ++l) {
              const Complex conj_basis =
                  m == 0 ? Complex(y[sh_index(l, 0)])
                         : Complex(y[sh_index(l, m)], -y[sh_index(l, -m)]) / std::numbers::sqrt2;
              for (int c = 0; c < map.channels; ++c)
                spectrum.values[spectrum.index(l, m) * map.channels + c] +=
                    weight * conj_basis * static_cast<double>(map.at(column, row)[c]);
            }
        }
  return spectrum;
}

// Odd and even heights, widths that are no powers of two or have a large prime factor, degrees beyond what the map resolves.
TEST(Analysis, EqualsTheDefinition) {
  const struct {
    int width, height, degree, channels;
  } cases[] = {{16, 8, 12, 3}, {10, 7, 9, 1}, {12, 5, 30, 3}, {2, 1, 5, 4}, {9, 16, 6, 3}, {74, 6, 9, 1}};
  for (const auto& c : cases) {
    const Image map = random_map(c.width, c.height, 7, c.channels);
    AnalysisOptions options;
    options.max_degree = c.degree;
    const Spectrum fast = analyze(map, options), slow = analyze_slowly(map, c.degree);
    ASSERT_EQ(fast.values.size(), slow.values.size());
    for (std::size_t i = 0; i < fast.values.size(); ++i)
      ASSERT_LT(std::abs(fast.values[i] - slow.values[i]), 1e-11)
          << c.width << " x " << c.height << " index " << i;  // rounding of coefficients of about 4
  }
}

// Rows in both hemispheres and on the equator of an odd height.
TEST(Analysis, OfReplacedTexelsIsThatOfAMapThatHasThem) {
  for (int height : {7, 20, 40}) {
    Image map = random_map(2 * height, height, 3);
    AnalysisOptions options;
    options.max_degree = 15;
    for (int y : {0, height / 2, height - 3}) options.replaced.push_back({y + 1, y, {5, 6, 7}});
    const Spectrum replaced = analyze(map, options);
    for (const auto& texel : options.replaced) std::copy_n(texel.value.begin(), 3, map.at(texel.x, texel.y));
    EXPECT_EQ(replaced.values, analyze(map, {.max_degree = 15}).values) << height;
  }
}

TEST(Analysis, OfAConstantHasDegreeZeroOnly) {
  Image map(64, 33);
  std::fill(map.pixels.begin(), map.pixels.end(), 3.0f);
  AnalysisOptions options;
  options.max_degree = 40;
  const Spectrum spectrum = analyze(map, options);
  EXPECT_NEAR(spectrum.values[0].real(), 3 * std::sqrt(4 * std::numbers::pi), 1e-12);
  for (std::size_t i = 3; i < spectrum.values.size(); ++i)
    ASSERT_LT(std::abs(spectrum.values[i]), 1e-12);  // rounding
}

TEST(Synthesis, EqualsTheSlowSum) {
  const Spectrum spectrum = analyze(random_map(40, 20, 3), {.max_degree = 30});
  const SphereGrid grid = synthesize(spectrum, 48, 70);
  for (int row = 0; row < grid.rows; row += 5)
    for (int column = 0; column < grid.columns; column += 7) {
      const auto expected =
          evaluate(spectrum, equirect_direction({(column + 0.5) / grid.columns, (row + 0.5) / grid.rows}));
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(grid.at(row, column)[c], expected[c], 2e-6);  // float storage of values below 8
    }
}

// A map of degree 1000 with one coefficient, whose start underflows near the poles without the scales.
TEST(Synthesis, IsStableAtHighDegreeAndOrder) {
  for (const auto& [l, m] : {std::pair{1000, 600}, {1000, 1000}, {1000, 3}, {1000, 0}}) {
    Spectrum spectrum(1000, 1);
    spectrum.values[spectrum.index(l, m)] = Complex(0.6, m ? -0.8 : 0.0);
    const SphereGrid grid = synthesize(spectrum, 1200, 2400);
    std::vector<double> y(sh_count(1000));
    for (int row = 7; row < 1200; row += 131) {
      const Vec3 d = equirect_direction({777.5 / 2400, (row + 0.5) / 1200});
      evaluate_sh_basis({d.x, d.z, d.y}, 1000, y);
      const double expected = m ? std::numbers::sqrt2 * (0.6 * y[sh_index(l, m)] + 0.8 * y[sh_index(l, -m)])
                                : 0.6 * y[sh_index(l, 0)];
      ASSERT_NEAR(grid.at(row, 777)[0], expected, 1e-6)
          << l << " " << m << " row " << row;  // float storage of values below 10
    }
  }
}

// Analysis of degree L by patches of a synthesised map returns the coefficients times the box filter's losses only;
// with many rows those vanish as the square of the texel size.
TEST(Transform, RoundTripKeepsLowDegrees) {
  Spectrum spectrum(6, 3);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int m = 0; m <= 6; ++m)
    for (int l = m; l <= 6; ++l)
      for (int c = 0; c < 3; ++c)
        spectrum.values[spectrum.index(l, m) * 3 + c] = {normal(random), m ? normal(random) : 0.0};
  const SphereGrid grid = synthesize(spectrum, 512, 1024);
  Image map(1024, 512);
  for (int y = 0; y < 512; ++y) std::copy_n(grid.at(y, 0), 1024 * 3, map.at(0, y));
  const Spectrum back = analyze(map, {.max_degree = 6});
  for (std::size_t i = 0; i < back.values.size(); ++i)
    ASSERT_LT(std::abs(back.values[i] - spectrum.values[i]),
              2e-4);  // (l pi/512)^2/24 per axis, values to about 3
}

TEST(Transform, IsBitIdenticalOnAnyNumberOfThreads) {
  const Image map = random_map(100, 50, 9);
  set_thread_count(1);
  const Spectrum once = analyze(map, {.max_degree = 60});
  const SphereGrid grid = synthesize(once, 80, 140);
  for (int threads : {2, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(analyze(map, {.max_degree = 60}).values, once.values);
    EXPECT_EQ(synthesize(once, 80, 140).values, grid.values);
  }
  set_thread_count(0);
}

TEST(Interpolation, HasItsStatedError) {
  Spectrum spectrum(16, 1);
  spectrum.values[spectrum.index(16, 5)] = {1, 0.5};
  const SphereGrid grid = synthesize(spectrum, 128, 256);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = normalized({normal(random), normal(random), normal(random)});
    float value = 0;
    interpolate(grid, d, &value);
    worst = std::max(worst, std::abs(value - evaluate(spectrum, d)[0]));
  }
  EXPECT_LT(worst, 3e-6);  // 2e-3 (pi/8)^8 times an amplitude of about 2
  EXPECT_GT(worst, 1e-9);
}

}  // namespace
}  // namespace welkin
