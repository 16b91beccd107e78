#include <numbers>
#include <random>

#include "measure.h"

#include <welkin/sampling/quadrature.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/rotation_rgb.h>

// Rotation of spherical-harmonic coefficients. Truth: the function's values, f(d) in the turned direction. Yardstick of
// the small sets: what a program does that has no rotation, projecting the turned function again from a cube of
// 16 x 16 texels a face.

namespace {

using namespace welkin;

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

Mat3 random_rotation(std::mt19937& random) {
  const Vec3 x = random_direction(random), b = random_direction(random);
  const Vec3 y = normalized(b - dot(x, b) * x);
  return {{x, y, cross(x, y)}};
}

ShCoefficients noise(int degree, int channels, std::mt19937& random) {
  std::normal_distribution<double> normal;
  ShCoefficients result(degree, channels);
  for (double& value : result.values) value = normal(random);
  return result;
}

// Largest error of the turned function in 50 directions, relative to its root mean square, (degree + 1)/sqrt(4 pi).
double pointwise_error(const ShCoefficients& f, const ShCoefficients& turned, const Mat3& r,
                       std::mt19937& random) {
  double error = 0, before[3], after[3];
  for (int i = 0; i < 50; ++i) {
    const Vec3 d = random_direction(random);
    evaluate(f, d, before);
    evaluate(turned, r * d, after);
    for (int c = 0; c < 3; ++c) error = std::max(error, std::abs(before[c] - after[c]));
  }
  return error * std::sqrt(4 * std::numbers::pi) / (f.max_degree + 1);
}

// The largest entry of V^T V - I after 1,000 rotations of the unit vectors of degree 64, every `step`-th of them.
double composed_error(bool by_matrices, int step, std::mt19937& random) {
  constexpr int degree = 64;
  const int columns = (2 * degree) / step + 1;
  ShCoefficients basis(degree, columns);
  for (int k = 0; k < columns; ++k) basis.values[sh_index(degree, k * step - degree) * columns + k] = 1;
  for (int i = 0; i < 1000; ++i) {
    const Mat3 r = random_rotation(random);
    basis = by_matrices ? rotate(basis, make_sh_rotation(r, degree)) : rotate(basis, r);
  }
  double error = 0;
  for (int a = 0; a < columns; ++a)
    for (int b = 0; b <= a; ++b) {
      double sum = 0;
      for (int m = -degree; m <= degree; ++m)
        sum +=
            basis.values[sh_index(degree, m) * columns + a] * basis.values[sh_index(degree, m) * columns + b];
      error = std::max(error, std::abs(sum - (a == b ? 1 : 0)));
    }
  return error;
}

void by_degree(bench::Report& report, std::mt19937& random) {
  report.note("RGB sets in double by degree: error in values, relative to their RMS; time of one rotation");
  for (int degree : {2, 5, 8, 16, 24, 32, 48, 64}) {
    const ShCoefficients f = noise(degree, 3, random);
    const Mat3 r = random_rotation(random);
    ShRotation matrices = make_sh_rotation(r, degree);
    ShCoefficients turned = rotate(f, matrices), by_turns = rotate(f, r);
    const double matrix_error = pointwise_error(f, turned, r, random);
    const double turn_error = pointwise_error(f, by_turns, r, random);
    const bench::Timing build = bench::measure(15, [&] { matrices = make_sh_rotation(r, degree); });
    const bench::Timing apply = bench::measure(15, [&] { turned = rotate(f, matrices); });
    const bench::Timing turns = bench::measure(15, [&] { by_turns = rotate(f, r); });
    const auto us = [](bench::Timing t) { return 1e6 * t.median; };
    report.note(
        fmt::format("degree {:>2}: I&R build {:9.2f} us, apply {:9.2f} us; zxzxz {:9.2f} us = 1/{:.1f}",
                    degree, us(build), us(apply), us(turns), (us(build) + us(apply)) / us(turns)));
    report.check("  Ivanic & Ruedenberg against values", matrix_error, 1e-12);
    report.check("  zxzxz against values", turn_error, 1e-12);
  }
}

// The turned function sampled at the texel centres of a cube and projected again; the basis is made beforehand.
struct CubeProjection {
  static constexpr int size = 16, coefficients = 36;
  std::vector<Vec3> directions;
  std::vector<float> weighted_basis;

  CubeProjection() {
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < size * size; ++i) {
        const double s = (2 * (i % size) + 1.0) / size - 1, t = (2 * (i / size) + 1.0) / size - 1;
        const double sign = face % 2 == 0 ? 1 : -1,
                     solid_angle = std::pow(1 + s * s + t * t, -1.5) * 4 / (size * size);
        const Vec3 axes[3] = {{sign, s, t}, {s, sign, t}, {s, t, sign}};
        directions.push_back(normalized(axes[face / 2]));
        double y[coefficients];
        evaluate_sh_basis(directions.back(), 5, y);
        for (double value : y) weighted_basis.push_back(static_cast<float>(value * solid_angle));
      }
  }

  void rotate_by_values(const float* in, const Mat3& r, float* out) const {
    const Mat3 back = transposed(r);
    std::fill_n(out, 3 * coefficients, 0.0f);
    double y[coefficients];
    for (std::size_t d = 0; d < directions.size(); ++d) {
      evaluate_sh_basis(back * directions[d], 5, y);
      float value[3] = {};
      for (int k = 0; k < coefficients; ++k)
        for (int c = 0; c < 3; ++c) value[c] += static_cast<float>(y[k]) * in[3 * k + c];
      for (int k = 0; k < coefficients; ++k)
        for (int c = 0; c < 3; ++c) out[3 * k + c] += weighted_basis[d * coefficients + k] * value[c];
    }
  }
};

double relative_error(std::span<const float> got, std::span<const double> truth) {
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    error = std::max(error, std::abs(got[i] - truth[i]));
    largest = std::max(largest, std::abs(truth[i]));
  }
  return error / largest;
}

void small_sets(bench::Report& report, std::mt19937& random) {
  constexpr int degree = 5, sets = 256, repeats = 20000;
  constexpr std::size_t size = sh_rgb_size(degree);
  std::vector<Mat3> rotations;
  std::vector<float> in, out(sets * size);
  double single = 0, scalar = 0, many = 0;
  const Mat3 common = random_rotation(random);
  const RgbTurn turn = make_rgb_turn(common);
  std::vector<double> truths;
  for (int s = 0; s < sets; ++s) {
    const ShCoefficients f = noise(degree, 3, random);
    const std::vector<float> set(f.values.begin(), f.values.end());
    in.insert(in.end(), set.begin(), set.end());
    rotations.push_back(random_rotation(random));
    const std::vector<double> truth = rotate(f, make_sh_rotation(rotations[s], degree)).values;
    float got[size];
    rotate_rgb(rotations[s], degree, set, got);
    single = std::max(single, relative_error(got, truth));
    rotate_rgb_scalar(make_rgb_turn(rotations[s]), degree, set, got);
    scalar = std::max(scalar, relative_error(got, truth));
    const std::vector<double> turned = rotate(f, make_sh_rotation(common, degree)).values;
    truths.insert(truths.end(), turned.begin(), turned.end());
  }
  rotate_rgb_sets(turn, degree, in, out);
  many = relative_error(out, truths);

  report.note("\nRGB set of degree 5 in floats (36 x 3), one core");
  const auto view = [](auto& all, int s) { return std::span(all).subspan(s * size, size); };
  const auto line = [&](const char* what, bench::Timing t, double count, double error, double goal_us) {
    report.note(fmt::format("{:<48} {:7.4f} us best {:7.4f} us median{}", what, 1e6 * t.best / count,
                            1e6 * t.median / count,
                            goal_us > 0 ? fmt::format("   goal {} us", goal_us) : ""));
    report.check("  error, of the largest coefficient", error, 1e-6);
    return t.median / count;
  };
  const double one = line("one set, everything from the Mat3",
                          bench::measure(15,
                                         [&] {
                                           for (int i = 0; i < repeats; ++i)
                                             rotate_rgb(rotations[i % sets], degree, view(in, i % sets),
                                                        view(out, i % sets));
                                         }),
                          repeats, single, 0.3);
  line("one set, in place again and again (latency)",
       bench::measure(15,
                      [&] {
                        for (int i = 0; i < repeats; ++i)
                          rotate_rgb(rotations[i % sets], degree, view(out, 0), view(out, 0));
                      }),
       repeats, single, 0.3);
  line("one set, scalar version",
       bench::measure(15,
                      [&] {
                        for (int i = 0; i < repeats; ++i)
                          rotate_rgb_scalar(make_rgb_turn(rotations[i % sets]), degree, view(in, i % sets),
                                            view(out, i % sets));
                      }),
       repeats, scalar, 0);
  line("the turn alone, from the Mat3",
       bench::measure(15,
                      [&] {
                        float sum = 0;
                        for (int i = 0; i < repeats; ++i) sum += make_rgb_turn(rotations[i % sets]).cos_a[1];
                        out[0] = sum;
                      }),
       repeats, single, 0);
  line("many sets, one rotation, a set",
       bench::measure(15,
                      [&] {
                        for (int i = 0; i < repeats / sets; ++i) rotate_rgb_sets(turn, degree, in, out);
                      }),
       repeats / sets * sets, many, 0);

  const CubeProjection cube;
  const ShCoefficients f = noise(degree, 3, random);
  const std::vector<float> set(f.values.begin(), f.values.end());
  float projected[size];
  cube.rotate_by_values(set.data(), common, projected);
  const double cube_error = relative_error(projected, rotate(f, common).values);
  const bench::Timing t = bench::measure(15, [&] { cube.rotate_by_values(set.data(), common, projected); });
  report.note(
      fmt::format("projection again from a cube 16 x 16 x 6          {:7.1f} us median, error {:.1e}: {:.0f} "
                  "x the time of one set",
                  1e6 * t.median, cube_error, t.median / one));
}

}  // namespace

int main() {
  bench::Report report;
  std::mt19937 random(1);
  by_degree(report, random);
  report.note("\n1,000 rotations composed at degree 64: departure from orthogonality");
  report.check("  zxzxz, 33 of the functions", composed_error(false, 4, random), 1e-10);
  report.check("  Ivanic & Ruedenberg, 17 of the functions", composed_error(true, 8, random), 1e-10);
  small_sets(report, random);
  return report.exit_code();
}
