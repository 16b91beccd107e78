#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <welkin/brdf/brdf_spec.h>
#include <welkin/brdf/ggx.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// The share of light from cos_view that is reflected, channel 1: integral of f cos over the hemisphere, by Gauss nodes
// in pieces of theta and of the azimuth from the mirror's, finest near the mirror direction and near grazing.
double albedo(const IsotropicBrdf& brdf, double cos_view) {
  const QuadratureRule rule = gauss_legendre(16);
  const double mirror = std::acos(cos_view);
  std::vector<double> thetas{0, pi / 2}, azimuths{0, pi};
  for (double width = 1; width > 1e-3; width /= 2) {
    for (double theta : {mirror - width, mirror + width, pi / 2 - width})
      if (theta > 0 && theta < pi / 2) thetas.push_back(theta);
    azimuths.push_back(pi - width);
    if (width / std::sin(mirror + 1e-9) < pi) azimuths.push_back(pi - width / std::sin(mirror + 1e-9));
  }
  std::sort(thetas.begin(), thetas.end());
  std::sort(azimuths.begin(), azimuths.end());
  const auto integral = [&](const std::vector<double>& edges, const std::function<double(double)>& f) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double half = (edges[i + 1] - edges[i]) / 2;
        sum += half * rule.weights[k] * f(edges[i] + half * (1 + rule.nodes[k]));
      }
    return sum;
  };
  return integral(thetas, [&](double theta) {
    const double ring =
        integral(azimuths, [&](double azimuth) { return brdf.value(std::cos(theta), cos_view, azimuth)[1]; });
    return 2 * ring * std::cos(theta) * std::sin(theta);
  });
}

const std::vector<std::string> specs = {"lambert:0.8",
                                        "phong:0",
                                        "phong:40,0.5:1:0.25",
                                        "blinn-phong:0",
                                        "blinn-phong:100",
                                        "ggx:0.05,1",
                                        "ggx:0.3",
                                        "ggx:1,1:0.5:0.2",
                                        "ward:0.05",
                                        "ward:0.3,0.5",
                                        "ggx-dielectric:0.2,1.5",
                                        "ggx-conductor:0.2,0.2:0.9:1.1,3.9:2.4:2.2",
                                        "ward:1"};

TEST(BrdfModels, AreReciprocal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  for (const std::string& spec : specs) {
    const IsotropicBrdf brdf = parse_brdf(spec);
    for (int i = 0; i < 200; ++i) {
      const double a = uniform(random), b = uniform(random), azimuth = pi * uniform(random);
      const auto forth = brdf.value(a, b, azimuth), back = brdf.value(b, a, azimuth);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(forth[c], back[c], 1e-12 * forth[c]) << spec;  // rounding
    }
  }
}

TEST(BrdfModels, ReflectNoMoreThanArrives) {
  for (const std::string& spec : specs) {
    const IsotropicBrdf brdf = parse_brdf(spec);
    for (double cos_view : {1.0, 0.9, 0.7, 0.5, 0.3, 0.15, 0.05, 0.02}) {
      const double reflected = albedo(brdf, cos_view);
      EXPECT_LE(reflected, 1 + 1e-4) << spec << " cos " << cos_view;  // the quadrature's error at grazing
      EXPECT_GT(reflected, 0) << spec << " cos " << cos_view;
    }
  }
}

TEST(BrdfModels, NormalisedModelsReflectTheirScaleAtNormalView) {
  // Closed forms; the quadrature is far better than 1e-6 for these smooth lobes.
  EXPECT_NEAR(albedo(parse_brdf("lambert:0.8"), 0.6), 0.8, 1e-9);
  for (const char* exponent : {"0", "1", "7", "300"}) {
    EXPECT_NEAR(albedo(parse_brdf(std::string("phong:") + exponent), 1), 1, 1e-6) << exponent;
    EXPECT_NEAR(albedo(parse_brdf(std::string("blinn-phong:") + exponent + ",0.7"), 1), 0.7, 1e-6)
        << exponent;
  }
}

TEST(BrdfModels, GgxIsDistributionTimesVisibilityTimesFresnel) {
  // At normal incidence everything is known: D = 1 / (pi alpha^2), V = 1/4, F = f0.
  const auto value = parse_brdf("ggx:0.2,0.1:0.5:1").value(1, 1, 0);
  const std::array<double, 3> f0{0.1, 0.5, 1};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], f0[c] / (4 * pi * 0.04), 1e-12);
  // The mirror's pair at any angle has the half vector along the normal.
  const double cosine = 0.35;
  EXPECT_NEAR(parse_brdf("ggx:0.2,0.1").value(cosine, cosine, pi)[0],
              ggx_distribution(1, 0.2) * ggx_visibility(cosine, cosine, 0.2) * fresnel_schlick(cosine, 0.1),
              1e-12);
  EXPECT_NEAR(
      parse_brdf("ggx-dielectric:0.2,1.5").value(cosine, cosine, pi)[0],
      ggx_distribution(1, 0.2) * ggx_visibility(cosine, cosine, 0.2) * fresnel_dielectric(cosine, 1.5),
      1e-12);
}

TEST(BrdfModels, PhongPeaksInTheMirrorDirection) {
  const IsotropicBrdf phong = make_phong_brdf(50);
  EXPECT_NEAR(phong.value(0.4, 0.4, pi)[0], 52 / (2 * pi), 1e-10);
  const double off = std::cos(0.2);  // light and mirrored view 0.2 apart in the plane of incidence
  EXPECT_NEAR(phong.value(std::cos(0.9), std::cos(0.7), pi)[0], 52 / (2 * pi) * std::pow(off, 50), 1e-10);
}

TEST(BrdfModels, WardIsThatOf1992AtNormalViewAndBoundedAtGrazing) {
  const IsotropicBrdf ward = make_ward_brdf(0.3);
  EXPECT_NEAR(ward.value(1, 1, 0)[0], 1 / (4 * pi * 0.09), 1e-12);
  // That of 1992 has 1 / sqrt(cos cos): its albedo for alpha 0.3 exceeds 1 at grazing angles.
  IsotropicBrdf old = ward;
  old.value = [](double l, double v, double azimuth) {
    const double hh = 2 * (1 + cos_between(l, v, azimuth)), hn2 = (l + v) * (l + v);
    const double value = std::exp(-(hh / hn2 - 1) / 0.09) / (4 * pi * 0.09 * std::sqrt(l * v));
    return std::array<double, 3>{value, value, value};
  };
  EXPECT_GT(ward.value(0.1, 0.1, pi)[0], old.value(0.1, 0.1, pi)[0]);
  EXPECT_LT(albedo(ward, 0.02), 1);
}

std::string refusal(const std::string& spec) {
  try {
    parse_brdf(spec);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BrdfSpec, SaysWhatIsWrong) {
  const auto refused = [](const std::string& spec, const std::string& part) {
    const std::string message = refusal(spec);
    EXPECT_NE(message.find(part), std::string::npos) << spec << " -> " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  refused("", "valid are lambert:ALBEDO, phong:N[,SCALE]");
  refused("oren-nayar:1", "merl:FILE");
  refused("ggx", "a parameter is missing; its form is ggx:ALPHA[,F0]");
  refused("ggx:0.2,0.04,1", "too many");
  refused("ggx:0.2,1:2", "one number or three");
  refused("ggx:abc", "'abc' is not a number");
  refused("ggx:nan", "not a number");
  refused("ggx:0", "ggx alpha is 0");
  refused("ggx:0.1,1.5", "ggx f0 is 1.5");
  refused("lambert:1.01", "must lie in [0, 1]");
  refused("merl:", "file is missing");
  refused("merl:no/such.binary", "no/such.binary: cannot open");
}

}  // namespace
}  // namespace welkin
