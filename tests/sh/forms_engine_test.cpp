#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "forms_sample.h"

#include <welkin/sampling/quadrature.h>
#include <welkin/sh/forms/form.h>

// Each form, evaluated as the engine's own code does it, in the engine's own axes, against irradiance integrated
// directly. The formulas here are written down from the engines' sources (form.h names them), not from ours.

namespace welkin {
namespace {

using std::numbers::pi;
using Rgb = std::array<double, 3>;

// A radiance of degree 2: the truth, for which irradiance from nine coefficients is exact.
struct Light {
  double constant;
  Vec3 linear;
  double xx, yy, zz, xy, yz, zx;

  double operator()(Vec3 d) const {
    return constant + dot(linear, d) + xx * d.x * d.x + yy * d.y * d.y + zz * d.z * d.z + xy * d.x * d.y +
           yz * d.y * d.z + zx * d.z * d.x;
  }
};

// Integral over the cap of all directions with cos > lowest around the axis, of f(d, cos): Gauss in the cosine, equal
// steps in the angle around. Exact for what is used here, since odd powers of the sine cancel around the axis.
double integrate(Vec3 axis, double lowest, const std::function<double(Vec3, double)>& f) {
  const Vec3 t = normalized(cross(axis, std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 b = cross(axis, t);
  const QuadratureRule rule = gauss_legendre(8);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double mu = lowest + (1 - lowest) * (rule.nodes[i] + 1) / 2, sine = std::sqrt(1 - mu * mu);
    for (int k = 0; k < 16; ++k) {
      const double phi = 2 * pi * k / 16;
      const Vec3 d = mu * axis + sine * (std::cos(phi) * t + std::sin(phi) * b);
      sum += rule.weights[i] * (1 - lowest) / 2 * (2 * pi / 16) * f(d, mu);
    }
  }
  return sum;
}

struct Scene {
  std::array<Light, 3> lights;

  explicit Scene(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    for (Light& light : lights)
      light = {
          2,        {u(random), u(random), u(random)}, u(random), u(random), u(random), u(random), u(random),
          u(random)};
  }
  Rgb irradiance(Vec3 n) const {
    Rgb rgb;
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] = integrate(n, 0, [&](Vec3 d, double mu) { return mu * lights[c](d); });
    return rgb;
  }
  ShCoefficients radiance() const {
    ShCoefficients sh(2, 3);
    for (std::size_t i = 0; i < 9; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sh.values[i * 3 + c] = integrate({0, 0, 1}, -1, [&](Vec3 d, double) {
          std::array<double, 9> basis;
          evaluate_sh_basis(d, 2, basis);
          return lights[c](d) * basis[i];
        });
    return sh;
  }
};

// The engine's constants: as its source has them, with six digits, or unrounded.
struct Constants {
  double l0, l1, l2, l20, l22;  // irradiance of a harmonic over its polynomial
};
constexpr Constants six_digits{0.886227, 2 * 0.511664, 2 * 0.429043, 0.247708, 0.429043};
const Constants unrounded{pi * std::sqrt(1 / (4 * pi)), 2 * pi / 3 * std::sqrt(3 / (4 * pi)),
                          pi / 4 * std::sqrt(15 / (4 * pi)), pi / 4 * std::sqrt(5 / (16 * pi)),
                          pi / 4 * std::sqrt(15 / (16 * pi))};

using Numbers = ShFormNumbers;
double at(const Numbers& n, std::size_t i, std::size_t channel) { return n[i * 3 + channel]; }

// three.js: SphericalHarmonics3.getIrradianceAt; irradiance. zz_1 is its 0.743125 z z - 0.247708.
double three(const Numbers& sh, std::size_t c, Vec3 n, const Constants& k) {
  const double zz_1 = (&k == &six_digits ? 0.743125 : 3 * k.l20) * n.z * n.z - k.l20;
  return k.l0 * at(sh, 0, c) + k.l1 * (at(sh, 1, c) * n.y + at(sh, 2, c) * n.z + at(sh, 3, c) * n.x) +
         k.l2 * (at(sh, 4, c) * n.x * n.y + at(sh, 5, c) * n.y * n.z + at(sh, 7, c) * n.x * n.z) +
         zz_1 * at(sh, 6, c) + k.l22 * at(sh, 8, c) * (n.x * n.x - n.y * n.y);
}

// Godot 4: the lightmap capture of scene_forward_clustered.glsl; what is multiplied with the albedo.
double godot(const Numbers& sh, std::size_t c, Vec3 n, const Constants& k) {
  const double l1 = &k == &six_digits ? 1.023327 : k.l1;
  return k.l0 * at(sh, 0, c) + l1 * (at(sh, 1, c) * n.y + at(sh, 2, c) * n.z + at(sh, 3, c) * n.x) +
         k.l2 * (at(sh, 4, c) * n.x * n.y + at(sh, 5, c) * n.y * n.z + at(sh, 7, c) * n.x * n.z) +
         k.l20 * at(sh, 6, c) * (3 * n.z * n.z - 1) + k.l22 * at(sh, 8, c) * (n.x * n.x - n.y * n.y);
}

// Filament: Irradiance_SphericalHarmonics; ours in C, GLSL and HLSL are the same.
double filament(const Numbers& sh, std::size_t c, Vec3 n, const Constants&) {
  return at(sh, 0, c) + at(sh, 1, c) * n.y + at(sh, 2, c) * n.z + at(sh, 3, c) * n.x +
         at(sh, 4, c) * n.y * n.x + at(sh, 5, c) * n.y * n.z + at(sh, 6, c) * (3 * n.z * n.z - 1) +
         at(sh, 7, c) * n.z * n.x + at(sh, 8, c) * (n.x * n.x - n.y * n.y);
}

// dot(A, (n, 1)) + dot(B, n.xyzz * n.yzzx) + C (x x - y y): ShadeSH9 and GetSkySHDiffuse alike.
double packed(const std::array<double, 4>& a, const std::array<double, 4>& b, double c, Vec3 n) {
  return a[0] * n.x + a[1] * n.y + a[2] * n.z + a[3] + b[0] * n.x * n.y + b[1] * n.y * n.z +
         b[2] * n.z * n.z + b[3] * n.z * n.x + c * (n.x * n.x - n.y * n.y);
}

// Unity: PackCoefficients to unity_SHAr ... unity_SHC, then ShadeSH9.
double unity(const Numbers& sh, std::size_t c, Vec3 n, const Constants&) {
  return packed({at(sh, 3, c), at(sh, 1, c), at(sh, 2, c), at(sh, 0, c) - at(sh, 6, c)},
                {at(sh, 4, c), at(sh, 5, c), at(sh, 6, c) * 3, at(sh, 7, c)}, at(sh, 8, c), n);
}

// Unreal: SetupSkyIrradianceEnvironmentMapConstantsFromSkyIrradiance, then GetSkySHDiffuse.
double unreal(const Numbers& v, std::size_t c, Vec3 n, const Constants&) {
  const double root = std::sqrt(pi), c0 = 1 / (2 * root), c1 = std::sqrt(3) / (3 * root),
               c2 = std::sqrt(15) / (8 * root), c3 = std::sqrt(5) / (16 * root), c4 = 0.5 * c2;
  return packed({-c1 * at(v, 3, c), -c1 * at(v, 1, c), c1 * at(v, 2, c), c0 * at(v, 0, c) - c3 * at(v, 6, c)},
                {c2 * at(v, 4, c), -c2 * at(v, 5, c), 3 * c3 * at(v, 6, c), -c2 * at(v, 7, c)},
                c4 * at(v, 8, c), n);
}

// Babylon: SphericalHarmonics.FromPolynomial, preScaleForRendering, computeEnvironmentIrradiance. The polynomial is
// x, y, z, xx, yy, zz, yz, zx, xy.
double babylon(const Numbers& p, std::size_t c, Vec3 n, const Constants& k) {
  const bool six = &k == &six_digits;
  const double third = six ? 0.376127 : 1 / (3 * k.l0), third_z = six ? 0.376126 : third;
  const double first = six ? 0.977204 : 1 / k.l1, mixed = six ? 1.16538 : 1 / k.l2;
  const double z20 = six ? 1.34567 : 1 / (3 * k.l20), xy20 = six ? 0.672834 : z20 / 2;
  const double xx = at(p, 3, c), yy = at(p, 4, c), zz = at(p, 5, c);
  std::array<double, 9> h{third * (xx + yy) + third_z * zz,
                          -first * at(p, 1, c),
                          first * at(p, 2, c),
                          -first * at(p, 0, c),
                          mixed * at(p, 8, c),
                          -mixed * at(p, 6, c),
                          z20 * zz - xy20 * (xx + yy),
                          -mixed * at(p, 7, c),
                          mixed * (xx - yy)};
  const double k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (4 * pi));
  const std::array<double, 9> scale{
      std::sqrt(1 / (4 * pi)),  -k1, k1, -k1, k2, -k2, std::sqrt(5 / (16 * pi)), -k2,
      std::sqrt(15 / (16 * pi))};
  for (std::size_t i = 0; i < 9; ++i) h[i] *= pi * scale[i];
  return h[0] + h[1] * n.y + h[2] * n.z + h[3] * n.x + h[4] * n.y * n.x + h[5] * n.y * n.z +
         h[6] * (3 * n.z * n.z - 1) + h[7] * n.z * n.x + h[8] * (n.x * n.x - n.y * n.y);
}

// Where a direction of a glTF scene is after the engine's importer.
Vec3 as_it_is(Vec3 d) { return d; }
Vec3 unity_import(Vec3 d) {
  return {-d.x, d.y, d.z};
}  // UnityGLTF: CoordinateSpaceConversionScale (-1, 1, 1)
Vec3 unreal_import(Vec3 d) { return {d.x, d.z, d.y}; }  // GLTF::ConvertVec3
Vec3 babylon_import(Vec3 d) {  // __root__: scale (1, 1, -1), then 180 degrees about y
  const Vec3 scaled{d.x, d.y, -d.z};
  return {-scaled.x, scaled.y, -scaled.z};
}

struct Engine {
  ShForm form;
  double (*evaluate)(const Numbers&, std::size_t, Vec3, const Constants&);
  Vec3 (*import)(Vec3);
  double over;  // what irradiance is divided by
};
void PrintTo(const Engine& engine, std::ostream* out) { *out << sh_form_name(engine.form); }

const Engine engines[] = {
    {ShForm::three, three, as_it_is, 1},         {ShForm::babylon, babylon, babylon_import, pi},
    {ShForm::filament, filament, as_it_is, pi},  {ShForm::unity, unity, unity_import, pi},
    {ShForm::unreal, unreal, unreal_import, pi}, {ShForm::godot, godot, as_it_is, pi},
    {ShForm::c, filament, as_it_is, pi},         {ShForm::glsl, filament, as_it_is, pi},
    {ShForm::hlsl, filament, as_it_is, pi}};

class FormOfEngine : public testing::TestWithParam<Engine> {};
INSTANTIATE_TEST_SUITE_P(Engines, FormOfEngine, testing::ValuesIn(engines),
                         [](const auto& tested) { return std::string(sh_form_name(tested.param.form)); });

// The largest error over directions, over the largest irradiance.
double engine_error(const Engine& engine, const Constants& constants) {
  double error = 0, largest = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Scene scene(seed);
    const Numbers numbers = to_sh_form(scene.radiance(), engine.form);
    std::mt19937 random(seed + 10);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 40; ++i) {
      const Vec3 n = normalized({normal(random), normal(random), normal(random)});
      const Rgb truth = scene.irradiance(n);
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = engine.evaluate(numbers, c, engine.import(n), constants);
        error = std::max(error, std::abs(value - truth[c] / engine.over));
        largest = std::max(largest, std::abs(truth[c] / engine.over));
      }
    }
  }
  return error / largest;
}

// All is double precision and exact for degree 2: rounding only.
TEST_P(FormOfEngine, GivesTheExactIrradiance) { EXPECT_LT(engine_error(GetParam(), unrounded), 1e-13); }

// three.js, Babylon and Godot have constants of six digits, rounded by up to 1.7e-6 of themselves; Babylon takes the
// harmonics from differences of its polynomial, which doubles that.
TEST_P(FormOfEngine, GivesTheIrradianceWithTheDigitsOfTheEngine) {
  EXPECT_LT(engine_error(GetParam(), six_digits), GetParam().form == ShForm::babylon ? 5e-6 : 2e-6);
}

// Light from one side of ours comes from the side where the engine's importer puts that side of a model.
TEST_P(FormOfEngine, IsBrightestWhereTheImporterPutsTheLight) {
  for (const Vec3 from :
       {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
    ShCoefficients radiance(2, 3);  // of a small light
    std::array<double, 9> basis;
    evaluate_sh_basis(from, 2, basis);
    for (std::size_t i = 0; i < 27; ++i) radiance.values[i] = basis[i / 3];
    const Numbers numbers = to_sh_form(radiance, GetParam().form);
    const Vec3 there = GetParam().import(from);
    const double value = GetParam().evaluate(numbers, 1, there, unrounded);
    for (const Vec3 other :
         {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
      const double there_or_less = dot(other, there) > 0.5 ? value + 1e-12 : value / 2;
      EXPECT_LE(GetParam().evaluate(numbers, 1, other, unrounded), there_or_less);
    }
  }
}

TEST_P(FormOfEngine, SaysItsAxes) {
  for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Vec3 said = sh_form_axes(GetParam().form) * d, truth = GetParam().import(d);
    EXPECT_EQ(length(said - truth), 0);
  }
  EXPECT_EQ(sh_form_quantity(GetParam().form),
            GetParam().over == 1 ? ShQuantity::irradiance : ShQuantity::irradiance_over_pi);
}

TEST_P(FormOfEngine, ComesBack) {
  const ShCoefficients radiance = random_document(5).coefficients;
  const ShCoefficients back = from_sh_form(to_sh_form(radiance, GetParam().form), GetParam().form);
  EXPECT_LT(relative_difference(radiance, back), 1e-13);  // rounding
}

// Constant radiance 1: the numbers that anyone can compare with what an engine shows.
TEST(Forms, OfAConstant) {
  ShCoefficients one(0, 3);  // degree 0: what is missing counts as 0
  one.values.assign(3, std::sqrt(4 * pi));
  EXPECT_NEAR(to_sh_form(one, ShForm::three)[0], 3.544908, 1e-6);
  EXPECT_NEAR(to_sh_form(one, ShForm::unreal)[0], 3.544908, 1e-6);
  EXPECT_NEAR(to_sh_form(one, ShForm::godot)[0], 1.128379, 1e-6);
  for (ShForm form : {ShForm::filament, ShForm::unity, ShForm::c})
    EXPECT_NEAR(to_sh_form(one, form)[0], 1, 1e-14);
  const Numbers babylon_numbers = to_sh_form(one, ShForm::babylon);
  for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(babylon_numbers[i], i >= 9 && i < 18 ? 1 : 0, 1e-14);
}

}  // namespace
}  // namespace welkin
