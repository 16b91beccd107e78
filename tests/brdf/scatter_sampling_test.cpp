#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <tests/brdf/scatter_cases.h>
#include <tests/oracles/chi_square.h>
#include <welkin/brdf/scatter/sampling_check.h>
#include <welkin/error.h>

namespace welkin {
namespace {

using scatter_test::Case;
using scatter_test::cases;
using scatter_test::views;

constexpr int samples = 1 << 15;

struct Checked {
  const Case* of;
  Vec3f view;
  SamplingCheck check;
};

// Every case at every view, once for all tests of this file.
const std::vector<Checked>& checked() {
  static const std::vector<Checked> all = [] {
    std::vector<Checked> made;
    std::uint32_t seed = 1;
    for (const Case& c : cases())
      for (const Vec3f view : views())
        made.push_back({&c, view, check_sampling(c.scatter(), view, {.samples = samples, .seed = seed++})});
    return made;
  }();
  return all;
}

// Together the tests fail by chance once in a thousand times; seeds are fixed. Delta samples count as lost.
void expect_density() {
  const double threshold = oracle::sidak_threshold(1e-3, static_cast<int>(checked().size()));
  for (const Checked& c : checked()) {
    const oracle::ChiSquare result = oracle::chi_square(c.check.observed, c.check.expected);
    EXPECT_GT(result.p, threshold) << c.of->spec << " at " << c.view.z << ": " << result.statistic << " of "
                                   << result.degrees_of_freedom;
  }
}

void expect_p() {
  const Checked& c = checked()[4];
  std::vector<double> sorted = c.check.expected;  // one pooling order for both: only bins of 5 and more
  std::vector<double> observed, expected;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (sorted[i] >= 5) observed.push_back(c.check.observed[i]), expected.push_back(sorted[i]);
  const double exact = oracle::chi_square(observed, expected).p;
  EXPECT_NEAR(c.check.p, exact, 0.05);  // pools differ by a few bins, and the cube root is near to 1e-3
}

void expect_kept() {
  for (const Checked& c : checked()) {
    EXPECT_LT(c.check.pdf_integral, 1 + 2e-4) << c.of->spec;  // the quadrature's error
    const double kept = c.check.pdf_integral, error = std::sqrt(std::max(0.0, kept * (1 - kept)) / samples);
    EXPECT_NEAR(c.check.kept, kept, 4.5 * error + 2e-4) << c.of->spec << " at " << c.view.z;
  }
}

void expect_pdf() {
  for (const Checked& c : checked()) EXPECT_EQ(c.check.pdf_error, 0) << c.of->spec;  // the same code
}

// Mean weight against quadrature; delta lobes are what quadrature lacks, and are tested by losslessness.
void expect_mean() {
  for (const Checked& c : checked()) {
    if (c.check.delta > 0) continue;
    const auto near = [&](float sampled, float exact, float error) {
      EXPECT_NEAR(sampled, exact, 4.5 * error + 1e-3 * exact) << c.of->spec << " at " << c.view.z;
    };
    near(c.check.sampled_albedo.r, c.check.quadrature_albedo.r, c.check.standard_error.r);
    near(c.check.sampled_albedo.g, c.check.quadrature_albedo.g, c.check.standard_error.g);
    near(c.check.sampled_albedo.b, c.check.quadrature_albedo.b, c.check.standard_error.b);
  }
}

void expect_bounded() {
  // Dielectric coats seen at grazing angles: F of facets that face away from the mean is up to 1 where the lobe was
  // chosen with the mean of F. All others are near 2.
  for (const Checked& c : checked()) EXPECT_LT(c.check.largest_weight, 6) << c.of->spec << " at " << c.view.z;
}

void expect_passive() {
  for (const Checked& c : checked()) {
    EXPECT_LT(max_channel(c.check.quadrature_albedo), 1 + 1e-3) << c.of->spec;  // Oren-Nayar's kinks: 1e-3
    EXPECT_LT(max_channel(c.check.sampled_albedo), 1 + 1e-3 + 4.5 * max_channel(c.check.standard_error))
        << c.of->spec;
  }
}

// By quadrature, to 1e-3: energy tables interpolated, and Oren-Nayar's kinks. A smooth coat's share is that of samples.
void expect_lossless() {
  int tested = 0;
  for (const Checked& c : checked()) {
    if (!c.of->lossless) continue;
    const double smooth =
        c.of->scatter().model == ScatterModel::coated_diffuse && c.of->scatter().alpha_x == 0
            ? 0.04 + 0.96 * std::pow(1 - c.view.z, 5)
            : 0;
    EXPECT_NEAR(c.check.quadrature_albedo.g + smooth, 1, 1e-3) << c.of->spec << " at " << c.view.z;
    EXPECT_NEAR(c.check.sampled_albedo.g, 1, 4.5 * c.check.standard_error.g + 1e-3) << c.of->spec;
    ++tested;
  }
  EXPECT_EQ(tested, 66);
}

void expect_albedo() {
  for (const Checked& c : checked()) {
    if (c.check.delta > 0) continue;
    const Scatter& s = c.of->scatter();
    // With a table 1e-3; a conductor's F is taken at the view; powers without a table are fits.
    double tolerance = 1.5e-3;
    if (s.model == ScatterModel::ggx_conductor) tolerance = 0.02;
    const bool power = s.model == ScatterModel::phong || s.model == ScatterModel::blinn_phong ||
                       s.model == ScatterModel::lafortune;
    if (power && !s.energy) tolerance = 0.15;
    if (s.model == ScatterModel::ggx && s.alpha_x != s.alpha_y && !s.energy) tolerance = 0.03;
    const Rgb albedo = approximate_albedo(s, c.view), exact = c.check.quadrature_albedo;
    EXPECT_NEAR(albedo.r, exact.r, tolerance) << c.of->spec << " at " << c.view.z;
    EXPECT_NEAR(albedo.g, exact.g, tolerance) << c.of->spec << " at " << c.view.z;
    EXPECT_NEAR(albedo.b, exact.b, tolerance) << c.of->spec << " at " << c.view.z;
  }
}

// One test for all, because each test is a process and the samples are what takes time.
TEST(ScatterSampling, HoldsForEveryModelAndView) {
  expect_density();
  expect_p();
  expect_kept();
  expect_pdf();
  expect_mean();
  expect_bounded();
  expect_passive();
  expect_lossless();
  expect_albedo();
}

// The same by a million samples; their standard error is 5e-4 at most, and with the seeds fixed 1e-3 holds.
TEST(ScatterFurnace, LosslessModelsReflectEverythingOfAMillionSamples) {
  for (const char* spec : {"ggx:0.4,1,compensated", "phong:30,1,compensated", "coated-diffuse:0.05,1",
                           "metallic-roughness:0.1,1,0.5,compensated", "oren-nayar:0.4,1"}) {
    const OwnedScatter owned = parse_scatter(spec);
    const SamplingCheck check = check_sampling(owned.scatter, views()[1], {.samples = 1000000, .seed = 5});
    EXPECT_NEAR(check.sampled_albedo.r, 1, 1e-3) << spec;
  }
}

TEST(ScatterDelta, MirrorsReflectTheirColour) {
  const Vec3f view = views()[1];
  const ScatterSample mirror = sample(parse_scatter("mirror:1:0.5:0.25").scatter, view, {0.3f, 0.7f}, 0.5f);
  EXPECT_TRUE(mirror.is_delta());
  EXPECT_EQ(mirror.light, (Vec3f{-view.x, -view.y, view.z}));
  EXPECT_EQ(mirror.weight.g, 0.5f);
  for (const char* spec : {"mirror", "conductor:0.2,3.9", "dielectric:1.5"}) {
    const Scatter s = parse_scatter(spec).scatter;
    EXPECT_TRUE(is_delta(s));
    EXPECT_TRUE(is_black(evaluate(s, {-view.x, -view.y, view.z}, view))) << spec;
    EXPECT_EQ(pdf(s, {-view.x, -view.y, view.z}, view), 0) << spec;
    EXPECT_EQ(approximate_albedo(s, view).r, sample(s, view, {}, 0).weight.r);
  }
  EXPECT_FALSE(is_delta(parse_scatter("coated-diffuse:0,1").scatter));
}

TEST(SamplingCheck, RefusesASilentNumberOfSamples) {
  EXPECT_THROW(check_sampling({}, {0, 0, 1}, {.samples = 10}), Error);
}

}  // namespace
}  // namespace welkin
