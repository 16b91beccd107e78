#include <welkin/sh/spin_synthesis.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/basis.h>

namespace welkin {
namespace {

Spectrum random_spectrum(int degree, int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Spectrum spectrum(degree, channels);
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l)
      for (int c = 0; c < channels; ++c)
        spectrum.values[spectrum.index(l, m) * channels + c] = {normal(random), m > 0 ? normal(random) : 0.0};
  return spectrum;
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// Filters that pick every local coefficient c_lq, in the order of q, then l.
std::vector<SpinFilter> all_coefficients(int degree, int channels) {
  std::vector<SpinFilter> filters;
  for (int q = 0; q <= degree; ++q) {
    for (int l = q; l <= degree; ++l) {
      filters.push_back({q, std::vector<double>((degree + 1) * channels)});
      for (int c = 0; c < channels; ++c) filters.back().factors[l * channels + c] = 1;
    }
  }
  return filters;
}

// f(omega) from the local coefficients at `centre`, as the header writes it.
double local_value(const SpinGrid& grid, int degree, Vec3 centre, Vec3 omega, int channel) {
  std::vector<float> c(grid.stride());
  interpolate(grid, centre, c);
  std::vector<double> y(sh_count(degree));
  evaluate_sh_basis(spin_frame(centre) * omega, degree, y);
  double sum = 0;
  std::size_t slot = 0;
  const auto next = [&] { return static_cast<double>(c[grid.channels * slot++ + channel]); };
  for (int q = 0; q <= degree; ++q) {
    for (int l = q; l <= degree; ++l) {
      if (q == 0) {
        sum += next() * y[sh_index(l, 0)];
      } else {
        sum += std::numbers::sqrt2 * next() * y[sh_index(l, q)];
        sum -= std::numbers::sqrt2 * next() * y[sh_index(l, -q)];
      }
    }
  }
  return sum;
}

TEST(SpinSynthesis, LocalCoefficientsGiveTheFunctionBack) {
  const int degree = 6;
  const Spectrum f = random_spectrum(degree, 3, 1);
  const SpinGrid grid = synthesize_spin(f, all_coefficients(degree, 3), 64, 128);
  std::mt19937 random(2);
  std::vector<Vec3> centres = {
      {0, 1, 0}, {0, -1, 0}, normalized({1e-3, 1, 2e-3}), normalized({0.01, -1, -0.03})};
  for (int i = 0; i < 50; ++i) centres.push_back(random_direction(random));
  for (const Vec3 centre : centres) {
    const Vec3 omega = random_direction(random);
    for (int c = 0; c < 3; ++c)  // 49 coefficients of size 1; floats, and interpolation at l = rows/10
      EXPECT_NEAR(local_value(grid, degree, centre, omega, c), evaluate(f, omega)[c], 3e-5);
  }
}

TEST(SpinSynthesis, HighestDegreeKeepsItsNorm) {
  // The sum over q of |c_lq|^2 is the sum over m of |a_lm|^2 everywhere; without interpolation, at samples.
  const int degree = max_spin_degree;
  Spectrum f(degree, 1);
  for (int m = 0; m <= degree; m += 16) f.values[f.index(degree, m)] = {1.0, m > 0 ? 0.5 : 0.0};
  std::vector<SpinFilter> filters;
  for (int q = 0; q <= degree; ++q) {
    filters.push_back({q, std::vector<double>(degree + 1)});
    filters.back().factors[degree] = 1;
  }
  const SpinGrid grid = synthesize_spin(f, filters, 8, 2 * degree + 2);
  const double power = degree_power(f)[degree];
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; column += 37) {
      const float* c = &grid.values[static_cast<std::size_t>(row * grid.columns + column) * grid.stride()];
      double sum = c[0] * c[0];
      for (int k = 1; k < grid.stride(); ++k) sum += 2 * c[k] * c[k];
      EXPECT_NEAR(sum / power, 1, 1e-5);  // floats; the recurrence over 128 degrees adds 1e-12
    }
  }
}

TEST(SpinSynthesis, SameBitsOnAnyNumberOfThreads) {
  const Spectrum f = random_spectrum(8, 3, 4);
  const auto filters = all_coefficients(8, 3);
  set_thread_count(1);
  const SpinGrid one = synthesize_spin(f, filters, 40, 80);
  set_thread_count(3);
  const SpinGrid three = synthesize_spin(f, filters, 40, 80);
  set_thread_count(0);
  EXPECT_EQ(one.values, three.values);
}

}  // namespace
}  // namespace welkin
