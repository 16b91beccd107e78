#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "../tests/sh/nonnegative_oracle.h"
#include "measure.h"

#include <welkin/sh/convolution.h>
#include <welkin/sh/irradiance_matrix.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/window.h>
#include <welkin/sh/zh3.h>
#include <welkin/sphere/vec3.h>

// Irradiance probes of coloured distant lights, whose exact irradiance is a sum of clamped cosines: time per probe of
// three channels, RMS and largest error over 500 directions relative to the probe's largest irradiance, averaged over
// 1000 probes (the largest over all); "adds" is what a method adds to the error of degree 2 itself, as a share of what
// the window adds (errors at right angles add in squares). Milliseconds for 1000 probes are microseconds for one.

namespace {

using namespace welkin;

constexpr int probe_count = 1000, direction_count = 500;

struct Light {
  Vec3 direction;
  std::array<double, 3> power;
};

struct Probe {
  std::vector<Light> lights;
  ShCoefficients irradiance{2, 3};
};

std::vector<Probe> make_probes(int least, int most, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Probe> probes(probe_count);
  for (Probe& probe : probes) {
    ShCoefficients radiance(2, 3);
    probe.lights.resize(least + static_cast<int>(random() % (most - least + 1)));
    for (Light& light : probe.lights) {
      light.direction = normalized({normal(random), normal(random), normal(random)});
      std::array<double, 9> y;
      evaluate_sh_basis(light.direction, 2, y);
      for (int c = 0; c < 3; ++c) {
        light.power[c] = 0.1 + uniform(random);
        for (int k = 0; k < 9; ++k) radiance.values[3 * k + c] += light.power[c] * y[k];
      }
    }
    probe.irradiance = convolve(radiance, cosine_lobe(2));
  }
  return probes;
}

std::vector<Vec3> make_directions() {
  std::vector<Vec3> points(direction_count);
  for (int i = 0; i < direction_count; ++i) {
    const double z = (2 * i + 1.0) / direction_count - 1, r = std::sqrt(1 - z * z);
    const double phi = 2 * std::numbers::pi * i * (std::numbers::phi - 1);
    points[i] = {r * std::cos(phi), r * std::sin(phi), z};
  }
  return points;
}

struct Errors {
  double rms = 0, largest = 0, least_value = 0;
};

void add_errors(const Probe& probe, const ShCoefficients& fit, const std::vector<Vec3>& directions,
                Errors& errors) {
  double squares = 0, worst = 0, peak = 0, least = 0;
  for (const Vec3& n : directions) {
    std::array<double, 3> exact{}, value;
    for (const Light& light : probe.lights)
      for (int c = 0; c < 3; ++c) exact[c] += light.power[c] * std::max(0.0, dot(n, light.direction));
    evaluate(fit, n, value);
    for (int c = 0; c < 3; ++c) {
      squares += (value[c] - exact[c]) * (value[c] - exact[c]);
      worst = std::max(worst, std::abs(value[c] - exact[c]));
      peak = std::max(peak, exact[c]);
      least = std::min(least, value[c]);
    }
  }
  errors.rms += std::sqrt(squares / (3 * direction_count)) / peak / probe_count;
  errors.largest = std::max(errors.largest, worst / peak);
  errors.least_value = std::min(errors.least_value, least / peak);
}

using Method = std::function<ShCoefficients(const ShCoefficients&)>;

double figure(bench::Report& report, const std::string& name, const std::vector<Probe>& probes,
              const Method& method, double limit, double plain_rms, double window_rms) {
  std::vector<ShCoefficients> fits(probes.size());
  const bench::Timing time = bench::measure(5, [&] {
    for (std::size_t i = 0; i < probes.size(); ++i) fits[i] = method(probes[i].irradiance);
  });
  static const std::vector<Vec3> directions = make_directions();
  Errors errors;
  for (std::size_t i = 0; i < probes.size(); ++i) add_errors(probes[i], fits[i], directions, errors);
  const auto added = [&](double rms) { return std::sqrt(std::max(0.0, rms * rms - plain_rms * plain_rms)); };
  const std::string ratio = window_rms > 0
                                ? fmt::format(", {:.2f} x window, adds {:.2f} x", errors.rms / window_rms,
                                              added(errors.rms) / added(window_rms))
                                : "";
  report.figure("  " + name, time, errors.rms, limit,
                fmt::format("rms ({:.4f}), {:.3f} largest, least value {:.3f}{}", errors.rms, errors.largest,
                            errors.least_value, ratio));
  return errors.rms;
}

// The fit against the barrier method, coefficient by coefficient.
void check_optimum(bench::Report& report, const std::vector<Probe>& probes) {
  constexpr int count = 30;
  double worst = 0;
  const double seconds = bench::seconds_of([&] {
    for (int i = 0; i < count; ++i) {
      const ShCoefficients fit = nonnegative_fit(probes[i].irradiance);
      for (int c = 0; c < 3; ++c) {
        oracle::Nine f;
        double largest = 0;
        for (int k = 0; k < 9; ++k)
          largest = std::max(largest, std::abs(probes[i].irradiance.values[3 * k + c]));
        for (int k = 0; k < 9; ++k) f[k] = probes[i].irradiance.values[3 * k + c] / largest;
        const oracle::Nine slow = oracle::nearest_nonnegative(f);
        for (int k = 0; k < 9; ++k)
          worst = std::max(worst, std::abs(slow[k] - fit.values[3 * k + c] / largest));
      }
    }
  });
  report.figure("  the same by a barrier method",
                {seconds / count * probe_count, seconds / count * probe_count}, worst, 1e-9,
                "difference of coefficients");
}

void bench_kind(bench::Report& report, const std::string& kind, int least, int most) {
  report.note(fmt::format("-- {}: {} probes of three channels", kind, probe_count));
  const auto probes = make_probes(least, most, 7);
  const double plain = figure(
      report, "degree 2 as it is", probes, [](const auto& f) { return f; }, 1, 0, 0);
  const double window = figure(
      report, "weakest Laplacian window", probes,
      [](const auto& f) { return laplacian_windowed(f, weakest_laplacian(f, WindowScope::each_channel)); }, 1,
      plain, 0);
  figure(
      report, "non-negative fit", probes, [](const auto& f) { return nonnegative_fit(f); },
      most == 1 ? 0.35 * window : window, plain, window);
  check_optimum(report, probes);
  figure(
      report, "ZH3, luminance axis", probes,
      [](const auto& f) { return zh3_to_sh(fit_zh3(f, zh3_luminance_axis(f))); }, 1, plain, window);
  figure(
      report, "ZH3, best axis", probes, [](const auto& f) { return zh3_to_sh(fit_zh3(f, zh3_best_axis(f))); },
      1, plain, window);
  figure(
      report, "ZH3, best axis, non-negative", probes,
      [](const auto& f) { return zh3_to_sh(nonnegative_zh3(fit_zh3(f, zh3_best_axis(f)))); }, 1, plain,
      window);
  figure(
      report, "ZH3 from degree 1 alone", probes, [](const auto& f) { return zh3_to_sh(hallucinate_zh3(f)); },
      1, plain, window);
}

void bench_vertices(bench::Report& report) {
  constexpr int count = 1 << 16;
  report.note(fmt::format("-- irradiance of {} normals", count));
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  std::vector<std::array<float, 3>> normals(count), fast(count), scalar(count);
  for (auto& n : normals) {
    const Vec3 d = normalized({normal(random), normal(random), normal(random)});
    n = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  const ShCoefficients f = make_probes(3, 3, 8).front().irradiance;
  const IrradianceMatrices matrices = irradiance_matrices(f);
  std::array<double, 3> value;
  double sum = 0;
  const bench::Timing plain = bench::measure(3, [&] {
    for (const auto& n : normals) {
      evaluate(f, {n[0], n[1], n[2]}, value);
      sum += value[0];
    }
  });
  const bench::Timing loop =
      bench::measure(9, [&] { irradiance_of_normals_scalar(matrices, normals, scalar); });
  const bench::Timing vectors = bench::measure(9, [&] { irradiance_of_normals(matrices, normals, fast); });
  double worst = sum > 0 ? 0 : 1;
  for (int i = 0; i < count; ++i) {
    evaluate(f, {normals[i][0], normals[i][1], normals[i][2]}, value);
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(fast[i][c] - value[c]));
  }
  report.figure("  evaluate()", plain, 0, 0, "by definition");
  report.figure("  matrices, scalar", loop, worst, 3e-6, "");
  report.figure("  matrices, vectorised", vectors, worst, 3e-6,
                fmt::format("{:.0f} times evaluate(), {:.1f} times scalar", plain.best / vectors.best,
                            loop.best / vectors.best));
}

}  // namespace

int main() {
  bench::Report report;
  bench_kind(report, "one light", 1, 1);
  bench_kind(report, "a few lights", 2, 4);
  bench_kind(report, "smooth (12 lights)", 12, 12);
  bench_vertices(report);
  return report.exit_code();
}
