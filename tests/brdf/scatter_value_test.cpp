#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <tests/brdf/scatter_cases.h>
#include <welkin/brdf/brdf_spec.h>
#include <welkin/brdf/ggx.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/error.h>

namespace welkin {
namespace {

using scatter_test::Case;
using scatter_test::cases;

constexpr double pi = std::numbers::pi;

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float uniform() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
  Vec3f direction() {
    const float z = std::max(1e-3f, uniform()), phi = 6.2831853f * uniform(), s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

 private:
  std::mt19937 engine_;
};

LocalVec exact(Vec3f v) {
  const double length = std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

// Pairs half of which are where the BRDF is large: lights of its own samples.
template <class Check>
void for_pairs(const Scatter& s, int count, Check check) {
  Random random(11);
  for (int i = 0; i < count; ++i) {
    const Vec3f view = random.direction();
    const ScatterSample drawn = sample(s, view, {random.uniform(), random.uniform()}, random.uniform());
    check(random.direction(), view);
    if (drawn.pdf > 0 && !drawn.is_delta()) check(drawn.light, view);
  }
}

double azimuth_between(LocalVec a, LocalVec b) {
  return std::abs(std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y));
}

// float's rounding of the half vector, 6e-8, over its height and the width of the lobe, and that of ten operations.
double tolerance(double width, Vec3f light, Vec3f view) { return 1e-4 + 1e-6 / (width * (light.z + view.z)); }

TEST(ScatterValue, IsTheClosedFormInDouble) {
  struct Pair {
    const char *scatter, *closed;
    double width;
  };
  for (const Pair& p :
       std::initializer_list<Pair>{{"lambert:0.8", "lambert:0.8", 1},
                                   {"phong:0", "phong:0", 1},
                                   {"phong:40,0.5", "phong:40,0.5", 0.15},
                                   {"phong:10000", "phong:10000", 0.01},
                                   {"blinn-phong:0", "blinn-phong:0", 1},
                                   {"blinn-phong:300", "blinn-phong:300", 0.05},
                                   {"blinn-phong:30000", "blinn-phong:30000", 0.005},
                                   {"ggx:0.001,1", "ggx:0.001,1", 0.001},
                                   {"ggx:0.1,0.3", "ggx:0.1,0.3", 0.1},
                                   {"ggx:1", "ggx:1", 1},
                                   {"ggx-conductor:0.3,0.2,3.9", "ggx-conductor:0.3,0.2,3.9", 0.3},
                                   {"ggx-conductor:0.5,3,0.1", "ggx-conductor:0.5,3,0.1", 0.5}}) {
    const Scatter s = parse_scatter(p.scatter).scatter;
    const IsotropicBrdf closed = parse_brdf(p.closed);
    for_pairs(s, 3000, [&](Vec3f light, Vec3f view) {
      const LocalVec l = exact(light), v = exact(view);
      const double azimuth = azimuth_between(l, v);
      // cos^0 ends in a step, which rounding moves.
      if (s.model == ScatterModel::phong && std::abs(l.z * v.z - l.x * v.x - l.y * v.y) < 1e-6) return;
      const double expected = closed.value(l.z, v.z, azimuth)[0] * l.z;
      // Powers of 1e4 and more are far below everything else outside of their lobe.
      EXPECT_NEAR(evaluate(s, light, view).r, expected, tolerance(p.width, light, view) * expected + 1e-12)
          << p.scatter << " l.z " << l.z << " v.z " << v.z << " azimuth " << azimuth;
    });
  }
}

TEST(ScatterValue, IsLafortunesLobe) {
  for (const char* lobe : {"-1:-1:1:20", "-0.9:-0.6:1:8", "0.6:0.6:0.5:5", "-1.2:-1.2:0.9:30"}) {
    const Scatter s = parse_scatter("lafortune:" + std::string(lobe)).scatter;
    const LafortuneBrdf closed = parse_lafortune(lobe);
    for_pairs(s, 2000, [&](Vec3f light, Vec3f view) {
      const double expected = evaluate(closed, exact(light), exact(view))[0] * light.z;
      // Where the cosine itself is near 0 its rounding is amplified by the exponent: an absolute floor.
      EXPECT_NEAR(evaluate(s, light, view).r, expected, 1e-4 * expected + 1e-6) << lobe;
    });
  }
}

// Walter et al. 2007 and Heitz 2014 as published: slopes by tangents and azimuths.
TEST(ScatterValue, IsAnisotropicGgxAsPublished) {
  const double ax = 0.1, ay = 0.5;
  const Scatter s = parse_scatter("ggx:0.1:0.5,1").scatter;
  const auto slope2 = [&](LocalVec w, double x, double y) {
    return (w.x * w.x * x * x + w.y * w.y * y * y) / (w.z * w.z);
  };
  const auto lambda = [&](LocalVec w) { return (std::sqrt(1 + slope2(w, ax, ay)) - 1) / 2; };
  for_pairs(s, 3000, [&](Vec3f light, Vec3f view) {
    const LocalVec l = exact(light), v = exact(view);
    LocalVec h{l.x + v.x, l.y + v.y, l.z + v.z};
    const double length = std::sqrt(dot(h, h));
    h = {h.x / length, h.y / length, h.z / length};
    const double d = 1 / (pi * ax * ay * std::pow(h.z, 4) * std::pow(1 + slope2(h, 1 / ax, 1 / ay), 2));
    const double expected = d / (1 + lambda(v) + lambda(l)) / (4 * v.z);
    EXPECT_NEAR(evaluate(s, light, view).r, expected, 1e-4 * expected);
  });
}

// Portsmouth, Kutz & Hill 2024 as published: their G(theta), A and average.
TEST(ScatterValue, IsEonAsPublished) {
  const double sigma = 0.5, albedo = 0.7, s2 = sigma * sigma;
  const double r = 0.45 * s2 / (s2 + 0.09) / (1 - 0.5 * s2 / (s2 + 0.33));
  const double a = 1 / (1 + (0.5 - 2 / (3 * pi)) * r), b = r * a;
  const auto energy = [&](double c) {
    const double theta = std::acos(c), s = std::sin(theta);
    return a + b / pi * (s * (theta - s * c) + 2.0 / 3 * (s / c * (1 - s * s * s) - s));
  };
  const double average = a * (1 + (2.0 / 3 - 28 / (15 * pi)) * r);
  const double multiple = albedo * albedo * average / (1 - albedo * (1 - average));
  const Scatter scatter = parse_scatter("oren-nayar:0.5,0.7").scatter;
  for_pairs(scatter, 3000, [&](Vec3f light, Vec3f view) {
    const LocalVec l = exact(light), v = exact(view);
    const double s = dot(l, v) - l.z * v.z, t = s > 0 ? std::max(l.z, v.z) : 1;
    const double expected =
        (albedo * (a + b * s / t) + multiple * (1 - energy(l.z)) * (1 - energy(v.z)) / (1 - average)) * l.z /
        pi;
    // s is a difference of numbers up to 1 in float.
    EXPECT_NEAR(evaluate(scatter, light, view).r, expected, 1e-4 * expected);
  });
}

TEST(ScatterValue, IsReciprocal) {
  for (const Case& c : cases()) {
    const Scatter& s = c.scatter();
    for_pairs(s, 400, [&](Vec3f light, Vec3f view) {
      const Rgb there = (1 / light.z) * evaluate(s, light, view);
      const Rgb back = (1 / view.z) * evaluate(s, view, light);
      // Interpolation in the tables rounds alike in both directions: what is left are float operations.
      EXPECT_NEAR(there.g, back.g, 2e-4f * there.g + 1e-12f) << c.spec << " " << light.z << " " << view.z;
    });
  }
}

void expect_sane(const Case& c, Vec3f view, Vec2f u, float lobe) {
  const ScatterSample drawn = sample(c.scatter(), view, u, lobe);
  const auto good = [](float x) { return x >= 0 && x < 1e9f; };  // false for NaN
  EXPECT_TRUE(good(drawn.weight.r) && good(drawn.weight.g) && good(drawn.weight.b)) << c.spec << view.z;
  if (is_black(drawn.weight)) return;
  EXPECT_GT(drawn.light.z, 0) << c.spec;
  EXPECT_NEAR(dot(drawn.light, drawn.light), 1, 1e-5) << c.spec << " " << view.z << " " << u.x << " " << u.y;
  EXPECT_GT(drawn.pdf, 0) << c.spec;
  const Rgb albedo = approximate_albedo(c.scatter(), view);
  EXPECT_TRUE(good(albedo.r) && albedo.r <= 1.001f) << c.spec << " " << view.z << " " << albedo.r;
}

TEST(ScatterValue, ExtremeInputsAreFine) {
  const std::vector<float> ends{0, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
  std::vector<Vec3f> directions{{0, 0, 1},      {1, 0, 1e-20f},      {-1, 0, 1e-20f},
                                {0, -1, 1e-8f}, {0.6f, 0.8f, 1e-4f}, {1e-6f, 0, 1}};
  Random random(3);
  for (int i = 0; i < 20; ++i) directions.push_back(random.direction());
  for (const Case& c : cases())
    for (const Vec3f view : directions) {
      for (const float x : ends)
        for (const float y : ends)
          for (const float lobe : {0.0f, 0.5f, 1 - 0x1p-24f}) expect_sane(c, view, {x, y}, lobe);
      for (const Vec3f light : directions) {
        const ScatterValue v = evaluate_with_pdf(c.scatter(), light, view);
        EXPECT_TRUE(v.value.r >= 0 && v.value.g >= 0 && v.value.b >= 0 && v.pdf >= 0) << c.spec;
        EXPECT_TRUE(v.value.r < INFINITY && v.pdf < INFINITY) << c.spec << " " << light.z << " " << view.z;
        EXPECT_TRUE(is_black(v.value) || v.pdf > 0) << c.spec << " " << light.z << " " << view.z;
      }
    }
}

TEST(ScatterValue, IsDarkBelowTheHorizon) {
  for (const Case& c : cases()) {
    EXPECT_TRUE(is_black(evaluate(c.scatter(), {0.6f, 0, -0.8f}, {0, 0, 1}))) << c.spec;
    EXPECT_TRUE(is_black(evaluate(c.scatter(), {0, 0, 1}, {0.6f, 0, -0.8f}))) << c.spec;
    EXPECT_EQ(pdf(c.scatter(), {1, 0, 0}, {0, 0, 1}), 0) << c.spec;
    EXPECT_TRUE(is_black(sample(c.scatter(), {1, 0, 0}, {0.5f, 0.5f}, 0.5f).weight)) << c.spec;
  }
}

TEST(ScatterSpec, SaysWhatIsWrong) {
  for (const char* wrong : {"velvet:1", "ggx", "ggx:2", "ggx:0.1:0.2:0.3", "lambert:0.5,1", "oren-nayar:0.1",
                            "lambert:1,compensated", "coated-diffuse:-0.1,1", "dielectric:0.5", "phong:nan",
                            "lafortune:1:1:1", "lafortune:-1:-1:1.2:9,1,compensated", ""})
    EXPECT_THROW(parse_scatter(wrong), Error) << wrong;
  try {
    parse_scatter("ggx:2");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "BRDF 'ggx:2': alpha is 2; it must lie in [0.001, 1]; its form is ggx:ALPHA[,F0][,compensated]");
  }
}

}  // namespace
}  // namespace welkin
