#include <gtest/gtest.h>

#include <limits>

#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/envmap/importance/inverse_table.h>
#include <welkin/error.h>

#include "importance_cases.h"
#include "tests/oracles/chi_square.h"

// That sample, pdf and inverse of EnvironmentSampler belong together, for every table, density and interpolation.

namespace welkin {
namespace {

using oracle::chi_square;
using oracle::sidak_threshold;

struct NamedMap {
  std::string name;
  Image map;
};

std::vector<NamedMap> maps() {
  return {{"noise", noise_map(32, 16, 3)},
          {"holes", holey_map(37, 19, 4)},
          {"sun", sun_map(64, 32, 1e5f)},
          {"one texel", one_texel_map(16, 8, 5, 2)},
          {"pole texel", one_texel_map(16, 8, 15, 0)},
          {"1 x 1", noise_map(1, 1, 6)},
          {"3 x 2", noise_map(3, 2, 7)},
          {"row", noise_map(17, 1, 8)},
          {"column", noise_map(1, 9, 9)}};
}

// Double-precision positions count the samples.
std::vector<double> counts(const EnvironmentSampler& sampler, const Image& map, int samples, unsigned seed) {
  std::vector<double> seen(static_cast<std::size_t>(map.width) * map.height);
  UnitNumbers numbers(seed);
  for (int i = 0; i < samples; ++i) {
    const Uv uv = uv_of(sampler.sample(numbers.two()).direction);
    const int x = std::min(static_cast<int>(uv.u * map.width), map.width - 1);
    const int y = std::min(static_cast<int>(uv.v * map.height), map.height - 1);
    seen[static_cast<std::size_t>(y) * map.width + x] += 1;
  }
  return seen;
}

// What the density of the box model has to be, from the map alone.
std::vector<double> box_shares(const Image& map, EnvironmentDensity density) {
  std::vector<double> shares;
  double sum = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const float* p = map.at(x, y);
      const double factor =
          density == EnvironmentDensity::luminance ? 1 : equirect_texel_solid_angle(map.width, map.height, y);
      shares.push_back(factor * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]));
      sum += shares.back();
    }
  for (double& share : shares) share /= sum;
  return shares;
}

// The inverse table finds its texels by bisection of the whole CDFs, to the bit.
TEST(InverseTable, ChoosesWhatBisectionFinds) {
  for (const NamedMap& one : maps()) {
    const Image& map = one.map;
    const InverseTable table({map, {0.2126f, 0.7152f, 0.0722f}, std::vector<double>(map.height, 1.0)});
    UnitNumbers numbers(9);
    for (int i = 0; i < 5000; ++i) {
      const Vec2f u = numbers.two();
      const TexelChoice choice = table.choose(u);
      const std::size_t y = last_not_above(table.row_cdf().data(), map.height, u.y);
      const float* cdf = table.column_cdfs().data() + y * (map.width + 1);
      ASSERT_EQ(choice.y, static_cast<int>(y)) << one.name;
      ASSERT_EQ(choice.x, static_cast<int>(last_not_above(cdf, map.width, u.x))) << one.name;
    }
  }
}

// Many at once and in two steps: the same bits.
TEST(EnvironmentSampler, BatchesGiveTheSame) {
  for (const EnvironmentSamplerOptions& options : all_options()) {
    const EnvironmentSampler sampler(sun_map(64, 32, 100), options);
    UnitNumbers numbers(10);
    std::vector<Vec2f> u(37);
    for (Vec2f& two : u) two = numbers.two();
    std::vector<EnvironmentSample> samples(u.size());
    sampler.sample(u, samples);
    std::vector<Vec3f> directions;
    for (const EnvironmentSample& sample : samples) directions.push_back(sample.direction);
    std::vector<EnvironmentPlace> places(u.size());
    sampler.places(directions, places);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const EnvironmentSample alone = sampler.sample(u[i]), there = sampler.at(alone.direction);
      const EnvironmentSample placed = sampler.at(alone.direction, places[i]);
      ASSERT_TRUE(samples[i].direction == alone.direction && samples[i].pdf == alone.pdf) << name_of(options);
      ASSERT_EQ(samples[i].radiance.g, alone.radiance.g) << name_of(options);
      ASSERT_TRUE(placed.direction == there.direction && placed.pdf == there.pdf) << name_of(options);
      ASSERT_EQ(placed.radiance.g, there.radiance.g) << name_of(options);
    }
  }
}

constexpr int chi_samples = 300'000;  // bench_sampling repeats this with 1e7 and more
constexpr int chi_tests = 12 * 9 + 2 * 12;

TEST(EnvironmentSampler, SamplesFollowThePdf) {
  unsigned seed = 100;
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      std::vector<double> expected = texel_integrals(sampler, one.map.width, one.map.height);
      for (double& e : expected) e = e < 1e-12 ? 0 : e * chi_samples;
      const std::vector<double> seen = counts(sampler, one.map, chi_samples, ++seed);
      EXPECT_GT(chi_square(seen, expected).p, sidak_threshold(0.01, chi_tests))
          << one.name << ", " << name_of(options);
    }
  }
}

// The pdf could be wrong together with the samples: the truth is the map.
TEST(EnvironmentSampler, SamplesOfTheBoxModelFollowTheMap) {
  unsigned seed = 300;
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      if (options.interpolation != EnvironmentInterpolation::box) continue;
      const EnvironmentSampler sampler(one.map, options);
      std::vector<double> expected = box_shares(one.map, options.density);
      for (double& e : expected) e *= 100'000;
      const std::vector<double> seen = counts(sampler, one.map, 100'000, ++seed);
      EXPECT_GT(chi_square(seen, expected).p, sidak_threshold(0.01, 6 * 9))
          << one.name << ", " << name_of(options);
    }
  }
}

// Where within a texel: 8 x 8 cells of equal share.
TEST(EnvironmentSampler, SamplesAreUniformWithinATexel) {
  for (const EnvironmentSamplerOptions& options : all_options()) {
    if (options.interpolation != EnvironmentInterpolation::box) continue;
    for (int row : {0, 1, 3}) {
      const EnvironmentSampler sampler(one_texel_map(8, 4, 2, row), options);
      const double top = std::cos(std::numbers::pi * row / 4),
                   bottom = std::cos(std::numbers::pi * (row + 1) / 4);
      std::vector<double> seen(64), expected(64, 100'000 / 64.0);
      UnitNumbers numbers(static_cast<unsigned>(7 + row));
      for (int i = 0; i < 100'000; ++i) {
        const Vec3f d = sampler.sample(numbers.two()).direction;
        const Uv uv = uv_of(d);
        const bool flat = options.density == EnvironmentDensity::luminance;
        const double down = flat ? uv.v * 4 - row : (d.y - top) / (bottom - top);
        const int i8 = std::clamp(static_cast<int>((uv.u * 8 - 2) * 8), 0, 7);
        const int j8 = std::clamp(static_cast<int>(down * 8), 0, 7);
        seen[8 * j8 + i8] += 1;
      }
      EXPECT_GT(chi_square(seen, expected).p, sidak_threshold(0.01, 18))
          << name_of(options) << ", row " << row;
    }
  }
}

TEST(EnvironmentSampler, PdfIntegratesToOne) {
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      double sum = 0;
      if (options.interpolation == EnvironmentInterpolation::box &&
          options.density == EnvironmentDensity::luminance_solid_angle) {
        for (int y = 0; y < one.map.height; ++y)
          for (int x = 0; x < one.map.width; ++x)
            sum += sampler.pdf(float_direction((x + 0.5) / one.map.width, (y + 0.5) / one.map.height)) *
                   equirect_texel_solid_angle(one.map.width, one.map.height, y);
      } else {
        for (double part : texel_integrals(sampler, one.map.width, one.map.height)) sum += part;
      }
      EXPECT_NEAR(sum, 1, 1e-6) << one.name << ", " << name_of(options);  // the bound
    }
  }
}

TEST(EnvironmentSampler, SampleTellsThePdfAndTheRadianceOfItsDirection) {
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      UnitNumbers numbers(5);
      // Box: the same texel, so exact but for sin theta. Interpolated: a direction is rounded by about 1e-7 of its
      // position, and a lit texel rises over 1 / width.
      const double slack = options.interpolation == EnvironmentInterpolation::box ? 2e-5 : 3e-3;
      for (int i = 0; i < 2000; ++i) {
        const EnvironmentSample sample = sampler.sample(numbers.two());
        const EnvironmentSample found = sampler.at(sample.direction);
        ASSERT_GT(sample.pdf, 0);
        ASSERT_GT(max_channel(sample.radiance), 0);
        ASSERT_NEAR(found.pdf, sample.pdf, slack * sample.pdf) << one.name << ", " << name_of(options);
        ASSERT_NEAR(luminance(found.radiance), luminance(sample.radiance),
                    slack * luminance(sample.radiance));
        ASSERT_NEAR(length(sample.direction), 1, 1e-6);
        ASSERT_EQ(sampler.pdf(sample.direction), found.pdf);
        ASSERT_EQ(sampler.radiance(sample.direction).g, found.radiance.g);
      }
    }
  }
}

TEST(EnvironmentSampler, ExtremeNumbersGiveSamples) {
  const float largest = std::nextafter(1.0f, 0.0f);
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      for (float x : {0.0f, 1e-30f, 0x1p-24f, 0.5f, largest})
        for (float y : {0.0f, 1e-30f, 0x1p-24f, 0.5f, largest}) {
          const EnvironmentSample sample = sampler.sample({x, y});
          ASSERT_GT(sample.pdf, 0) << one.name << ", " << name_of(options) << " " << x << " " << y;
          ASSERT_LT(sample.pdf, INFINITY);
          ASSERT_GT(max_channel(sample.radiance), 0);
          ASSERT_GT(sampler.pdf(sample.direction), 0);
        }
    }
  }
}

TEST(EnvironmentSampler, PdfIsPositiveExactlyWhereTheMapIsLit) {
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      UnitNumbers numbers(9);
      for (int i = 0; i < 3000; ++i) {
        const Vec2f at = numbers.two();
        const EnvironmentSample found = sampler.at(float_direction(at.x, at.y));
        ASSERT_EQ(found.pdf > 0, max_channel(found.radiance) > 0) << one.name << ", " << name_of(options);
      }
    }
  }
}

TEST(EnvironmentSampler, ABlackMapGivesNoSample) {
  for (const EnvironmentSamplerOptions& options : all_options()) {
    const EnvironmentSampler sampler(Image(8, 4), options);
    EXPECT_EQ(sampler.sample({0.3f, 0.6f}).pdf, 0);
    EXPECT_EQ(sampler.pdf({0, 1, 0}), 0);
    EXPECT_EQ(sampler.mean_luminance(), 0);
  }
}

TEST(EnvironmentSampler, InverseUndoesSample) {
  for (const NamedMap& one : maps()) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      const EnvironmentSampler sampler(one.map, options);
      if (options.interpolation == EnvironmentInterpolation::bilinear ||
          options.table == EnvironmentTable::alias) {
        EXPECT_THROW(sampler.inverse({0, 1, 0}), Error);
        continue;
      }
      UnitNumbers numbers(11);
      for (int i = 0; i < 2000; ++i) {
        const Vec2f u = numbers.two(), back = sampler.inverse(sampler.sample(u).direction);
        // Samples keep 2^-12 of a texel away from its edges; one texel can have all of the square.
        ASSERT_NEAR(back.x, u.x, 3e-4) << one.name << ", " << name_of(options);
        ASSERT_NEAR(back.y, u.y, 3e-4) << one.name << ", " << name_of(options);
      }
    }
  }
}

// 4096 stratified numbers: the share of a texel times 4096, off by what the borders of its patch of the square cut.
TEST(EnvironmentSampler, MonotoneTablesKeepStratification) {
  const Image map = noise_map(8, 4, 21);
  for (const EnvironmentSamplerOptions& options : all_options()) {
    if (options.interpolation == EnvironmentInterpolation::bilinear) continue;
    const EnvironmentSampler sampler(map, options);
    std::vector<double> seen(32);
    for (int i = 0; i < 4096; ++i) {
      const Vec2f u{(static_cast<float>(i % 64) + 0.5f) / 64, (static_cast<float>(i / 64) + 0.5f) / 64};
      const Uv uv = uv_of(sampler.sample(u).direction);
      seen[8 * static_cast<int>(uv.v * 4) + static_cast<int>(uv.u * 8)] += 1;
    }
    const std::vector<double> shares = box_shares(map, options.density);
    double worst = 0;
    for (int k = 0; k < 32; ++k) worst = std::max(worst, std::abs(seen[k] - 4096 * shares[k]));
    // A patch of the square is a x b of the 64 x 64 cells, and a whole number of rows times one of columns falls in it.
    const double bound = options.table == EnvironmentTable::alias ? 64 : 32;
    EXPECT_LT(worst, bound) << name_of(options);
  }
}

TEST(EnvironmentSampler, RefusesWhatItCannotSample) {
  EXPECT_THROW(EnvironmentSampler{Image()}, Error);
  EXPECT_THROW(EnvironmentSampler{Image(4, 2, 1)}, Error);
  for (float bad : {-1.0f, std::numeric_limits<float>::quiet_NaN(), INFINITY}) {
    Image map = noise_map(4, 2, 1);
    map.at(3, 1)[1] = bad;
    EXPECT_THROW(EnvironmentSampler{map}, Error);
  }
  EXPECT_THROW(EnvironmentSampler(noise_map(4, 2, 1), {.luminance_weights = {0, 1, 0}}), Error);
}

TEST(EnvironmentSampler, HugeAndTinyRadianceAreSampledAlike) {
  for (float scale : {1e-24f, 1e38f}) {
    for (const EnvironmentSamplerOptions& options : all_options()) {
      Image map(4, 2);
      for (int k = 0; k < 4; ++k) map.at(k, 1)[0] = scale * static_cast<float>(k);
      const EnvironmentSampler sampler(map, options);
      double sum = 0;
      for (double part : texel_integrals(sampler, 4, 2)) sum += part;
      EXPECT_NEAR(sum, 1,
                  options.density == EnvironmentDensity::luminance ? 1e-5 : 0.2);  // Gauss, not exact for box
      EXPECT_GT(sampler.sample({0.5f, 0.5f}).pdf, 0);
    }
  }
}

TEST(EnvironmentSampler, MeanLuminanceIsThatOfTheSphere) {
  EXPECT_NEAR(EnvironmentSampler(constant_map(8, 4, 2)).mean_luminance(), 2, 1e-6);
}

}  // namespace
}  // namespace welkin
