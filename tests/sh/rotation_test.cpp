#include <welkin/sh/rotation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sh/algebra.h>

namespace welkin {
namespace {

Mat3 turn_about_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{Vec3{1, 0, 0}, Vec3{0, c, -s}, Vec3{0, s, c}}};
}

// Degree 1 is the vector (x, y, z): f(d) = v . d becomes (R v) . d. A quarter turn about +Z takes x to y.
TEST(ShRotation, TurnsAVectorWithTheMatrix) {
  const Mat3 quarter{{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}};
  ShCoefficients f(1, 1);
  f.values[sh_index(1, 1)] = 1;  // along x
  for (const ShCoefficients& turned : {rotate(f, quarter), rotate(f, make_sh_rotation(quarter, 1))}) {
    EXPECT_NEAR(turned.values[sh_index(1, -1)], 1, 1e-15);  // along y
    EXPECT_NEAR(turned.values[sh_index(1, 1)], 0, 1e-15);
    EXPECT_NEAR(turned.values[sh_index(1, 0)], 0, 1e-15);
  }
}

// The definition, for both methods: rotate(f, R)(R d) = f(d). Values are of the size degree/3.
TEST(ShRotation, MovesTheFunctionWithTheMatrix) {
  std::mt19937 random(1);
  for (int degree : {0, 1, 2, 5, 10, 11, 33, 64}) {
    const ShCoefficients f = random_coefficients(degree, 2, random);
    const Mat3 r = random_rotation(random);
    const ShCoefficients by_turns = rotate(f, r), by_matrix = rotate(f, make_sh_rotation(r, degree));
    for (int i = 0; i < 5; ++i) {
      const Vec3 d = random_unit_vector(random);
      EXPECT_LT(largest_difference(value_in(by_turns, r * d), value_in(f, d)), 1e-13 * (degree + 1));
      EXPECT_LT(largest_difference(value_in(by_matrix, r * d), value_in(f, d)), 1e-13 * (degree + 1));
    }
  }
}

// Where the axis of the second angle is lost, or nearly so, and where entries are exactly 0.
TEST(ShRotation, MethodsAgreeAlsoAtTheAxes) {
  std::mt19937 random(2);
  const Mat3 half_x{{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}};
  const Mat3 about_z{{Vec3{0.6, -0.8, 0}, Vec3{0.8, 0.6, 0}, Vec3{0, 0, 1}}};
  std::vector<Mat3> rotations{Mat3{}, half_x, about_z, product(half_x, about_z),
                              turn_about_x(0.5 * std::numbers::pi)};
  for (double tilt : {1e-5, 1e-8, 1e-12, 1e-16, 1e-200, 1e-310})
    for (const Mat3& base : {Mat3{}, half_x})
      rotations.push_back(product(product(about_z, product(base, turn_about_x(tilt))), about_z));
  for (const Mat3& r : rotations) {
    const ShCoefficients f = random_coefficients(20, 1, random);
    EXPECT_LT(largest_difference(rotate(f, r).values, rotate(f, make_sh_rotation(r, 20)).values),
              2e-13);  // rounding
  }
}

TEST(ShRotation, MatricesAreOrthogonal) {
  std::mt19937 random(3);
  const ShRotation rotation = make_sh_rotation(random_rotation(random), 64);
  for (int l : {1, 2, 7, 31, 64})
    for (int m = -l; m <= l; ++m)
      for (int k = -l; k <= m; ++k) {
        double sum = 0;
        for (int n = -l; n <= l; ++n) sum += rotation.at(l, m, n) * rotation.at(l, k, n);
        ASSERT_NEAR(sum, m == k ? 1 : 0, 1e-13)
            << l << " " << m << " " << k;  // rounding of 64 recurrence steps
      }
}

TEST(ShRotation, OfARotationIsTheRotationOfTheProduct) {
  std::mt19937 random(4);
  const Mat3 a = random_rotation(random), b = random_rotation(random);
  const ShCoefficients f = random_coefficients(12, 3, random);
  EXPECT_LT(largest_difference(rotate(rotate(f, a), b).values, rotate(f, product(b, a)).values), 1e-13);
}

// Eight unit vectors of degree 64, turned 1,000 times, stay orthonormal (bench/rotation_bench.cpp takes more); and
// they are where the product of the 1,000 matrices, itself kept orthogonal, takes them.
TEST(ShRotation, AThousandComposedRotationsStayOrthogonal) {
  constexpr int degree = 64, columns = 8;
  std::mt19937 random(5);
  ShCoefficients start(degree, columns);
  for (int k = 0; k < columns; ++k) start.values[sh_index(degree, 18 * k - 64) * columns + k] = 1;
  ShCoefficients basis = start;
  Mat3 total;
  for (int i = 0; i < 1000; ++i) {
    const Mat3 r = random_rotation(random);
    basis = rotate(basis, r);
    total = orthonormalized(product(r, total));
  }
  for (int a = 0; a < columns; ++a)
    for (int b = 0; b <= a; ++b) {
      double sum = 0;
      for (int m = -degree; m <= degree; ++m)
        sum +=
            basis.values[sh_index(degree, m) * columns + a] * basis.values[sh_index(degree, m) * columns + b];
      EXPECT_NEAR(sum, a == b ? 1 : 0, 1e-11);  // a tenth of the requirement; 5,000 passes of rounding
    }
  // The product of the 3 x 3 matrices drifts by about sqrt(1000) roundings, which degree 64 multiplies by 64.
  EXPECT_LT(largest_difference(rotate(start, total).values, basis.values), 1e-11);
}

TEST(ShRotation, MatrixOfFloatsRotatesAsWellAsItsRoundingLets) {
  std::mt19937 random(6);
  Mat3 r = random_rotation(random), rounded;
  for (int i = 0; i < 3; ++i)
    rounded.rows[i] = {static_cast<float>(r.rows[i].x), static_cast<float>(r.rows[i].y),
                       static_cast<float>(r.rows[i].z)};
  const ShCoefficients f = random_coefficients(64, 1, random), turned = rotate(f, rounded);
  EXPECT_NEAR(inner_product(turned, turned)[0] / inner_product(f, f)[0], 1, 1e-12);  // lengths are kept
  EXPECT_LT(largest_difference(turned.values, rotate(f, r).values), 64 * 1e-7 * 3);
}

TEST(ShRotation, MirrorChangesSignsOnly) {
  std::mt19937 random(7);
  const ShCoefficients f = random_coefficients(9, 2, random);
  const MirrorAxis axes[] = {MirrorAxis::x, MirrorAxis::y, MirrorAxis::z};
  for (int axis = 0; axis < 3; ++axis) {
    const ShCoefficients mirrored_f = mirror(f, axes[axis]);
    const Vec3 d = random_unit_vector(random);
    const Vec3 image{axis == 0 ? -d.x : d.x, axis == 1 ? -d.y : d.y, axis == 2 ? -d.z : d.z};
    EXPECT_LT(largest_difference(value_in(mirrored_f, image), value_in(f, d)), 1e-12);  // rounding
    EXPECT_EQ(mirror(mirrored_f, axes[axis]).values, f.values);
  }
}

TEST(ShRotation, RefusesWhatIsNoRotation) {
  const ShCoefficients f(2, 3);
  const Mat3 mirror_z{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}};
  const Mat3 stretched{{Vec3{1, 0, 0}, Vec3{0, 1.01, 0}, Vec3{0, 0, 1}}};
  const Mat3 skewed{{Vec3{1, 1e-3, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  const Mat3 broken{{Vec3{NAN, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  for (const Mat3& r : {mirror_z, stretched, skewed, broken}) {
    EXPECT_THROW(rotate(f, r), Error);
    EXPECT_THROW(make_sh_rotation(r, 2), Error);
  }
  EXPECT_THROW(make_sh_rotation(Mat3{}, 65), Error);
  EXPECT_THROW(make_sh_rotation(Mat3{}, -1), Error);
  EXPECT_THROW(rotate(ShCoefficients(65, 1), Mat3{}), Error);
  EXPECT_THROW(rotate(f, make_sh_rotation(Mat3{}, 1)), Error);
  EXPECT_THROW(rotate(ShCoefficients{}, Mat3{}), Error);
}

}  // namespace
}  // namespace welkin
