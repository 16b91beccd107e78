// Environment samplers: build time, memory, speed, noise against the full-size CDF, chi-square over 1e7 samples.
// bench_sampling [MAP]

#include <array>
#include <cmath>
#include <memory>
#include <random>

#include <welkin/envmap/environment.h>
#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/sphere/equirect.h>

#include "measure.h"
#include "tests/oracles/chi_square.h"

namespace {

using namespace welkin;

constexpr const char* names[] = {"inverse", "alias", "hierarchical"};

// Log-normal noise and a sun of 1e5 means.
Image test_map(int width) {
  Image map(width, width / 2);
  std::mt19937 random(7);
  for (float& value : map.pixels) {
    const float u = static_cast<float>(random() >> 8) * 0x1p-24f;
    value = 0.05f + u * u * u;
  }
  for (int c = 0; c < 3; ++c) map.at(width / 3, width / 8)[c] = 1e5f;
  return map;
}

Vec2f numbers(std::uint32_t i) {
  std::uint64_t v = (i + 1) * 0x9e3779b97f4a7c15u;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
  v ^= v >> 31;
  return {static_cast<float>(v >> 40) * 0x1p-24f, static_cast<float>((v >> 16) & 0xffffff) * 0x1p-24f};
}

// Second moment over the square of the mean of luminance / pdf, over the sphere: 1 for a perfect density.
double second_moment(const EnvironmentSampler& sampler) {
  const Image& map = sampler.map();
  double first = 0, second = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const float* p = map.at(x, y);
      const double light = luminance(Rgb{p[0], p[1], p[2]});
      const double solid_angle = equirect_texel_solid_angle(map.width, map.height, y);
      first += light * solid_angle;
      second += light * light / sampler.pdf(sampler.direction_in({x, y}, {0.5f, 0.5f})) * solid_angle;
    }
  return second / (first * first);
}

double chi_square_p(const EnvironmentSampler& sampler, std::uint32_t samples) {
  const Image& map = sampler.map();
  std::vector<double> seen(map.pixels.size() / 3), expected;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const auto at = sampler.texel_of(sampler.sample(numbers(i)).direction);
    seen[static_cast<std::size_t>(at.y) * map.width + at.x] += 1;
  }
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      expected.push_back(sampler.pdf(sampler.direction_in({x, y}, {0.5f, 0.5f})) /
                         sampler.texels_per_steradian(y) * static_cast<double>(samples));
  return oracle::chi_square(seen, expected).p;
}

void one_size(bench::Report& report, const Image& map) {
  double full = 1;
  for (auto table : {EnvironmentTable::inverse, EnvironmentTable::alias, EnvironmentTable::hierarchical}) {
    EnvironmentSamplerOptions options;
    options.table = table;
    Image copy = map;
    std::unique_ptr<EnvironmentSampler> sampler;
    const double build =
        bench::seconds_of([&] { sampler = std::make_unique<EnvironmentSampler>(std::move(copy), options); });
    const double moment = second_moment(*sampler);
    if (table == EnvironmentTable::inverse) full = moment;
    constexpr int count = 1'000'000;
    constexpr std::uint32_t batch = 16;
    std::array<Vec2f, batch> u;
    std::array<EnvironmentSample, batch> samples;
    float sum = 0;
    const bench::Timing time = bench::measure(5, [&] {
      for (std::uint32_t i = 0; i < count; i += batch) {  // as many as the renderer takes at once
        for (std::uint32_t k = 0; k < batch; ++k) u[k] = numbers(i + k);
        sampler->sample(u, samples);
        for (const EnvironmentSample& sample : samples) sum += sample.pdf;
      }
    });
    report.figure(
        fmt::format("{} x {} {}", map.width, map.height, names[static_cast<int>(table)]), time,
        std::abs(moment / full - 1), 0.02,
        fmt::format("{:.1f} M/s, build {:.0f} ms, {:.1f} % of the float CDF, noise {:.4f}{}",
                    count / time.best / 1e6, 1000 * build,
                    100.0 * static_cast<double>(sampler->table_bytes()) / (4.0 * map.width * map.height),
                    moment, sum > 0 ? "" : " "));
  }
}

}  // namespace

int main(int count, char** arguments) {
  bench::Report report;
  if (count > 1) {
    one_size(report, load_environment(arguments[1]).radiance);
  } else {
    for (int width : {1024, 2048, 4096, 8192}) one_size(report, test_map(width));
  }
  for (auto table : {EnvironmentTable::inverse, EnvironmentTable::alias, EnvironmentTable::hierarchical}) {
    EnvironmentSamplerOptions options;
    options.table = table;
    const double p = chi_square_p(EnvironmentSampler(test_map(64), options), 10'000'000);
    report.check(fmt::format("{}: 1 - p of chi-square, 1e7 samples", names[static_cast<int>(table)]), 1 - p,
                 0.99);
  }
  return report.exit_code();
}
