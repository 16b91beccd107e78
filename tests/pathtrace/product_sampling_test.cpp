#include <welkin/pathtrace/product_sampling.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <welkin/error.h>

#include "tests/envmap/importance_cases.h"
#include "tests/oracles/chi_square.h"

namespace welkin {
namespace {

struct Case {
  std::string name;
  Scatter scatter;
  Vec3f normal, view;  // view: local
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&all](const char* name, ScatterModel model, float alpha, Vec3f normal, Vec3f view) {
    Scatter s;
    s.model = model;
    s.alpha_x = s.alpha_y = alpha;
    s.color = {0.9f, 0.6f, 0.3f};
    all.push_back({name, s, normalized(normal), normalized(view)});
  };
  add("narrow metal", ScatterModel::ggx, 0.1f, {0.3f, 0.8f, -0.2f}, {0.3f, 0.1f, 0.8f});
  add("broad metal, grazing", ScatterModel::ggx, 0.4f, {-0.7f, 0.1f, 0.6f}, {0.9f, 0.1f, 0.2f});
  add("coated", ScatterModel::coated_diffuse, 0.2f, {0, 1, 0}, {-0.4f, 0.5f, 0.6f});
  add("lambert", ScatterModel::lambert, 1, {0.2f, -0.9f, 0.1f}, {0, 0, 1});
  add("mirror-like", ScatterModel::ggx, 0.02f, {0, 0, 1}, {0.2f, 0.3f, 0.9f});
  return all;
}

std::vector<Image> environments() {
  return {sun_map(64, 32, 1e4f), holey_map(37, 19, 4), noise_map(300, 150, 3), noise_map(3, 2, 7),
          one_texel_map(16, 8, 5, 2)};
}

ProductSample sampled(const ProductSampler& product, const Case& c, Vec2f u, float keep, Vec3f along,
                      float& density) {
  return product.sample(c.scatter, make_frame(c.normal), c.view, u, keep, along, density);
}

double density_at(const ProductSampler& product, const Case& c, Vec3f direction) {
  float density = 0;
  sampled(product, c, {0.5f, 0.5f}, 0.5f, direction, density);
  return density;
}

TEST(ProductSampler, DensityIntegratesToTheNumberOfCandidates) {
  for (const Image& map : environments()) {
    const EnvironmentSampler environment(map);
    const ProductSampler product(environment, {2});
    for (const Case& c : cases()) {
      double sum = 0;
      for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
          sum += density_at(product, c, float_direction((x + 0.5) / map.width, (y + 0.5) / map.height)) *
                 equirect_texel_solid_angle(map.width, map.height, y);
      // 0 all over: nothing is tabulated for lobes that narrow, nor where the lobe's window holds no light.
      EXPECT_NEAR(sum > 0 ? sum : 2, 2, 1e-5)
          << c.name << ", " << map.width;  // products of four floats a texel
    }
  }
}

// With one candidate nothing is compared: what is kept follows the density, but for what is below the horizon.
TEST(ProductSampler, CandidatesFollowTheDensity) {
  const Image map = noise_map(40, 20, 12);
  const EnvironmentSampler environment(map);
  const ProductSampler product(environment, {1});
  constexpr int samples = 300'000;
  for (const Case& c : cases()) {
    if (c.scatter.alpha_x < 0.03f) continue;
    std::vector<double> seen(800), expected(800);
    const LocalFrame frame = make_frame(c.normal);
    for (int k = 0; k < 800; ++k) {
      // Texels that the horizon cuts are left out of both.
      const Vec3f middle = float_direction((k % 40 + 0.5) / 40, (k / 40 + 0.5) / 20);
      if (frame.to_local(middle).z < 0.2f) continue;
      expected[k] = samples * density_at(product, c, middle) * equirect_texel_solid_angle(40, 20, k / 40);
    }
    double rest = samples;
    for (double e : expected) rest -= e;
    UnitNumbers numbers(31);
    double others = 0;
    for (int i = 0; i < samples; ++i) {
      float density = 0;
      const ProductSample s = sampled(product, c, numbers.two(), numbers.one(), c.normal, density);
      const EnvironmentSampler::Texel texel =
          environment.texel_of(is_black(s.light) ? -c.normal : s.direction);
      const int k = 40 * texel.y + texel.x;
      (expected[k] > 0 ? seen[k] : others) += 1;
    }
    seen.push_back(others);
    expected.push_back(rest);
    EXPECT_GT(oracle::chi_square(seen, expected).p, oracle::sidak_threshold(0.01, 4)) << c.name;
  }
}

// Against a sum over directions, 12 x 12 a texel, at least 384 across.
double reflected_light(const Image& map, const Case& c) {
  const LocalFrame frame = make_frame(c.normal);
  const int fine = std::max(4, 384 / map.width), wide = map.width * fine, high = map.height * fine;
  double sum = 0;
  for (int y = 0; y < high; ++y) {
    const double solid_angle = equirect_texel_solid_angle(wide, high, y);
    for (int x = 0; x < wide; ++x) {
      const float* p = map.at(x / fine, y / fine);
      const Vec3f light = frame.to_local(float_direction((x + 0.5) / wide, (y + 0.5) / high));
      sum += solid_angle * luminance(evaluate(c.scatter, light, c.view) * Rgb{p[0], p[1], p[2]});
    }
  }
  return sum;
}

TEST(ProductSampler, IsUnbiasedTogetherWithTheBrdf) {
  for (const Image& map : environments()) {
    const EnvironmentSampler environment(map);
    const ProductSampler product(environment);
    for (const Case& c : cases()) {
      const double truth = reflected_light(map, c);
      const LocalFrame frame = make_frame(c.normal);
      UnitNumbers numbers(41);
      double sum = 0, square = 0;
      constexpr int samples = 40'000;
      for (int i = 0; i < samples; ++i) {
        const ScatterSample s = sample(c.scatter, c.view, numbers.two(), numbers.one());
        const Vec3f along = frame.to_world(s.light);
        float density = 0;
        const ProductSample kept = sampled(product, c, numbers.two(), numbers.one(), along, density);
        double value = luminance(kept.light);
        if (!is_black(s.weight))
          value += s.pdf / (s.pdf + density) * luminance(s.weight * environment.radiance(along));
        sum += value;
        square += value * value;
      }
      const double mean = sum / samples,
                   error = std::sqrt(std::max(0.0, square / samples - mean * mean) / samples);
      // 25 means at 4.5 standard errors: 2e-4 by chance. The sum over directions is good to 0.5 % for the narrowest lobe.
      EXPECT_NEAR(mean, truth, 4.5 * error + 0.005 * truth) << c.name << ", " << map.width;
    }
  }
}

TEST(ProductSampler, BlackAndMirrorsGiveNothing) {
  const EnvironmentSampler black(Image(8, 4));
  const ProductSampler nothing(black);
  Case c = cases()[0];
  float density = 1;
  EXPECT_TRUE(is_black(sampled(nothing, c, {0.5f, 0.5f}, 0.5f, {0, 1, 0}, density).light));
  EXPECT_EQ(density, 0);
  const EnvironmentSampler lit(noise_map(8, 4, 1));
  c.scatter.model = ScatterModel::mirror;
  EXPECT_TRUE(is_black(sampled(ProductSampler(lit), c, {0.5f, 0.5f}, 0.5f, {0, 1, 0}, density).light));
  EXPECT_EQ(density, 0);
  EXPECT_THROW(ProductSampler(lit, {0}), Error);
}

}  // namespace
}  // namespace welkin
