#include <array>
#include <cmath>
#include <vector>

#include "measure.h"

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/folded_lookup.h>
#include <welkin/sh/lookup.h>
#include <welkin/sh/map_projection.h>
#include <welkin/sh/monte_carlo.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/resample.h>

// Every way to project a map to nine coefficients, and King's (2005) round trip: a 64 x 64 x 6 cube to nine
// coefficients, cosine convolution and back to a 32 x 32 x 6 irradiance cube, which took a GeForce 6800 1/300 s.

namespace {

using namespace welkin;

constexpr int radiance_size = 64, irradiance_size = 32;

template <class A, class B>
double relative_error(const A& values, const B& truth) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    largest = std::max<double>(largest, std::abs(truth[i]));
    difference = std::max<double>(difference, std::abs(static_cast<double>(values[i]) - truth[i]));
  }
  return difference / largest;
}

// Batches are short, so that the median is of batches in which nobody else got the core.
template <class Work>
bench::Timing per_call(int runs, int calls, Work&& work) {
  bench::Timing time = bench::measure(runs, [&] {
    for (int i = 0; i < calls; ++i) work();
  });
  return {time.best / calls, time.median / calls};
}

// Errors are of the largest coefficient, against exact patches of the same map. Resampling moves light by up to half
// a texel, 1/32 on the discs, which shows where all of it is one sun.
template <class Work>
void figure(bench::Report& report, const std::string& what, int runs, const ShCoefficients& truth,
            double limit, const std::string& remark, Work&& work) {
  ShCoefficients result;
  const bench::Timing time = bench::measure(runs, [&] { result = work(); });
  report.figure(what, time, relative_error(result.values, truth.values), limit, remark);
}

void bench_methods(bench::Report& report, const std::string& source, const SphereMap& equirect) {
  const SphereMap cube = resample(equirect, map_shape(Mapping::cube, radiance_size));
  const SphereMap discs = resample(equirect, map_shape(Mapping::dual_paraboloid, radiance_size));
  const ShCoefficients truth = project_map(equirect, 2);
  report.note(fmt::format("-- {} ({} x {}), nine coefficients; errors of the largest", source,
                          equirect.image.width, equirect.image.height));
  figure(report, "equirect, exact patches", 5, truth, 0, "the truth of the lines below",
         [&] { return project_map(equirect, 2); });
  figure(report, "equirect, texel centres", 5, truth, 1e-3, "King 2005, equation 10-3",
         [&] { return project_map(equirect, 2, TexelRule::centre); });
  for (const auto* map : {&cube, &discs}) {
    const std::string name(mapping_name(map->mapping));
    figure(report, name + " 64, integrated", 5, truth, 5e-2, "error of resampling",
           [&] { return project_map(*map, 2); });
    const ShCoefficients own = project_map(*map, 2);
    figure(report, name + " 64, texel centres", 5, own, 2e-2, "against its own texels integrated",
           [&] { return project_map(*map, 2, TexelRule::centre); });
    const auto lookup = make_sh_projection_lookup(map->shape());
    figure(report, name + " 64, look-up table", 11, own, 2e-2, "the same, scalar",
           [&] { return project(lookup, *map); });
    for (TexelRule rule : {TexelRule::centre, TexelRule::integrated}) {
      const auto table = make_sh_projection_table(map->shape(), 2, 3, rule);
      ShCoefficients result;
      const bench::Timing time = per_call(501, 10, [&] { project(table, *map, result); });
      const bool centre = rule == TexelRule::centre;
      report.figure(name + (centre ? " 64, folded table" : " 64, folded, integrated"), time,
                    relative_error(result.values, own.values), centre ? 2e-2 : 1e-5,
                    fmt::format("{:.1f} us", 1e6 * time.median));
    }
  }
}

// RMS error over coefficients and seeds against the exact one, and what the standard errors said (RMS too).
void bench_monte_carlo(bench::Report& report, const SphereMap& map) {
  const ShCoefficients truth = project_map(map, 2);
  const double largest =
      std::abs(*std::max_element(truth.values.begin(), truth.values.end(),
                                 [](double a, double b) { return std::abs(a) < std::abs(b); }));
  constexpr int seeds = 8;
  report.note(
      "-- Monte Carlo on the same map: RMS error of nine coefficients (stated standard error) of the "
      "largest");
  report.note(fmt::format("{:>10} {:>28} {:>28}", "samples", "uniform random", "low discrepancy"));
  for (std::uint64_t samples = 256; samples <= 1048576; samples *= 4) {
    std::string line = fmt::format("{:>10}", samples);
    for (SampleKind kind : {SampleKind::uniform_random, SampleKind::low_discrepancy}) {
      double error = 0, stated = 0;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const MonteCarloProjection p = project_monte_carlo(map, 2, {samples, seed, kind});
        for (std::size_t i = 0; i < truth.values.size(); ++i) {
          error += std::pow(p.coefficients.values[i] - truth.values[i], 2);
          stated += p.standard_errors[i] * p.standard_errors[i];
        }
      }
      const double scale = 1 / (seeds * static_cast<double>(truth.values.size()));
      line += fmt::format("        {:.2e} ({:.2e})", std::sqrt(error * scale) / largest,
                          std::sqrt(stated * scale) / largest);
    }
    report.note(line);
  }
}

// The direct sum: every texel of the irradiance cube over every texel of the radiance cube. Texel weights and
// directions are tabulated first; each pair then is a dot product, a clamp and a multiply-add per channel.
std::vector<double> brute_force_irradiance(const Cube& radiance) {
  struct Light {
    float x, y, z, r, g, b;
  };
  std::vector<Light> lights;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < radiance.size; ++y)
      for (int x = 0; x < radiance.size; ++x) {
        const Vec3 d = cube_texel_direction(radiance.size, face, x, y);
        const auto weight = static_cast<float>(cube_texel_solid_angle(radiance.size, x, y));
        const float* v = radiance.at(face, x, y);
        lights.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                          weight * v[0], weight * v[1], weight * v[2]});
      }
  std::vector<double> out;
  for (int i = 0; i < 6 * irradiance_size * irradiance_size; ++i) {
    const Vec3 n = cube_texel_direction(irradiance_size, i / (irradiance_size * irradiance_size),
                                        i % irradiance_size, i / irradiance_size % irradiance_size);
    const auto nx = static_cast<float>(n.x), ny = static_cast<float>(n.y), nz = static_cast<float>(n.z);
    float r = 0, g = 0, b = 0;
    for (const Light& light : lights) {
      const float cosine = std::max(0.0f, nx * light.x + ny * light.y + nz * light.z);
      r += cosine * light.r;
      g += cosine * light.g;
      b += cosine * light.b;
    }
    out.insert(out.end(), {r, g, b});
  }
  return out;
}

// Yardstick of the machine: every number of the cube read once and added, as the compiler makes it of a plain loop.
double plain_sum(const std::vector<float>& values) {
  std::array<float, 64> sums{};
  for (std::size_t i = 0; i + 64 <= values.size(); i += 64)
    for (std::size_t k = 0; k < 64; ++k) sums[k] += values[i + k];
  double sum = 0;
  for (float s : sums) sum += s;
  return sum;
}

void bench_round_trip(bench::Report& report, const std::string& source, const SphereMap& equirect) {
  const Cube radiance = cube_from_sphere_map(resample(equirect, map_shape(Mapping::cube, radiance_size)));
  report.note(fmt::format(
      "-- {}: cube of 64 to nine coefficients, convolution, irradiance cube of 32, one core", source));
  const auto to_sh = make_sh_projection_table(radiance_size);
  const auto from_sh = make_sh_synthesis_table(irradiance_size);
  const std::vector<double> lobe = cosine_lobe(2);

  const ShCoefficients in_double = convolve(project_cube(radiance, 2, TexelRule::centre), lobe);
  std::vector<double> truth;
  for (int i = 0; i < 6 * irradiance_size * irradiance_size; ++i) {
    double value[3];
    evaluate(in_double,
             cube_texel_direction(irradiance_size, i / (irradiance_size * irradiance_size),
                                  i % irradiance_size, i / irradiance_size % irradiance_size),
             value);
    truth.insert(truth.end(), value, value + 3);
  }

  ShCoefficients coefficients;
  Cube irradiance;
  const bench::Timing forward = per_call(501, 10, [&] { project(to_sh, radiance, coefficients); });
  const bench::Timing back = per_call(501, 10, [&] { synthesize(from_sh, coefficients, irradiance); });
  const bench::Timing round = per_call(501, 10, [&] {
    project(to_sh, radiance, coefficients);
    synthesize(from_sh, convolve(coefficients, lobe), irradiance);
  });
  volatile double keep = 0;
  const bench::Timing sum = per_call(501, 10, [&] { keep = plain_sum(radiance.texels); });
  std::vector<double> brute;
  bench::Timing brute_time;
  brute_time.best = brute_time.median = bench::seconds_of([&] { brute = brute_force_irradiance(radiance); });

  report.note(fmt::format("{:<40} {:.1f} us ({:.1f} GB/s of texels)", "projection, folded table",
                          1e6 * forward.median,
                          1e-9 * static_cast<double>(4 * radiance.texels.size()) / forward.median));
  report.note(fmt::format("{:<40} {:.1f} us", "synthesis, folded table", 1e6 * back.median));
  report.note(fmt::format("{:<40} {:.1f} us", "yardstick: a plain sum of the texels", 1e6 * sum.median));
  report.figure("round trip", round, relative_error(irradiance.texels, truth), 1e-5,
                fmt::format("against the same in double; {:.0f} a second, {:.0f} times brute force",
                            1 / round.median, brute_time.median / round.median));
  report.figure("brute force, 151 million pairs", brute_time, relative_error(truth, brute), 0.1,
                "of nine coefficients against it");
  report.note(fmt::format("{:<40} {}", "goal: 5,000 round trips a second",
                          round.median <= 200e-6 ? "kept" : "MISSED"));
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  std::vector<std::string> sources{"sky:day,size=512x256", "sky:overcast,size=512x256",
                                   "sky:studio,size=512x256"};
  sources.insert(sources.end(), argv + 1, argv + argc);
  for (const std::string& source : sources) {
    const SphereMap map{Mapping::equirectangular, load_environment(source).radiance};
    bench_methods(report, source, map);
    bench_monte_carlo(report, map);
    bench_round_trip(report, source, map);
  }
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_projection: {}\n", error.what());
  return 1;
}
