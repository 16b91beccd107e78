#include <welkin/sh/rotation_rgb.h>

#include <gtest/gtest.h>

#include <cmath>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sh/rotation.h>

namespace welkin {
namespace {

std::vector<float> as_floats(const ShCoefficients& set) { return {set.values.begin(), set.values.end()}; }

double largest_value(const std::vector<double>& values) {
  double largest = 0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

std::vector<Mat3> some_rotations(std::mt19937& random) {
  std::vector<Mat3> rotations{Mat3{}, {{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}}};
  for (double tilt : {1e-4, 1e-8, 1e-20})
    rotations.push_back(
        {{Vec3{1, 0, 0}, Vec3{0, std::cos(tilt), -std::sin(tilt)}, Vec3{0, std::sin(tilt), std::cos(tilt)}}});
  for (int i = 0; i < 200; ++i) rotations.push_back(random_rotation(random));
  return rotations;
}

// Against the matrices in double. 1e-6 is the promise: five passes of sums of up to six floats.
TEST(ShRotationRgb, AgreesWithTheMatricesInDouble) {
  std::mt19937 random(1);
  for (const Mat3& r : some_rotations(random))
    for (int degree = 0; degree <= 5; ++degree) {
      const ShCoefficients f = random_coefficients(degree, 3, random);
      const std::vector<double> truth = rotate(f, make_sh_rotation(r, degree)).values;
      const std::vector<float> in = as_floats(f);
      std::vector<float> out(in.size());
      rotate_rgb(r, degree, in, out);
      EXPECT_LT(largest_difference({out.begin(), out.end()}, truth), 1e-6 * largest_value(truth)) << degree;
    }
}

// The same sums in the same order; a fused multiply-add rounds once where the scalar code may round twice.
TEST(ShRotationRgb, VectorisedEqualsScalar) {
  std::mt19937 random(2);
  for (const Mat3& r : some_rotations(random))
    for (int degree = 0; degree <= 5; ++degree) {
      const std::vector<float> in = as_floats(random_coefficients(degree, 3, random));
      std::vector<float> fast(in.size()), scalar(in.size());
      rotate_rgb(make_rgb_turn(r), degree, in, fast);
      rotate_rgb_scalar(make_rgb_turn(r), degree, in, scalar);
      EXPECT_LT(largest_difference({fast.begin(), fast.end()}, {scalar.begin(), scalar.end()}), 4e-6);
    }
}

// Any number of sets, and nothing before or behind them is touched.
TEST(ShRotationRgb, ManySetsEqualOneByOneAndStayInTheirBounds) {
  std::mt19937 random(3);
  const RgbTurn turn = make_rgb_turn(random_rotation(random));
  for (int degree = 0; degree <= 5; ++degree)
    for (std::size_t count : {0, 1, 3, 4, 7, 12}) {
      const std::size_t size = sh_rgb_size(degree);
      std::vector<float> in(count * size), one_by_one(count * size), guarded(count * size + 32, 7.0f);
      for (float& value : in) value = static_cast<float>(random() % 1000) / 500 - 1;
      for (std::size_t s = 0; s < count; ++s)
        rotate_rgb(turn, degree, std::span(in).subspan(s * size, size),
                   std::span(one_by_one).subspan(s * size, size));
      rotate_rgb_sets(turn, degree, in, std::span(guarded).subspan(16, in.size()));
      for (std::size_t i = 0; i < in.size(); ++i)
        ASSERT_NEAR(guarded[16 + i], one_by_one[i], 2e-6);  // rounding
      for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(guarded[i], 7);
        EXPECT_EQ(guarded[16 + in.size() + i], 7);
      }
    }
}

TEST(ShRotationRgb, WorksInPlace) {
  std::mt19937 random(4);
  const RgbTurn turn = make_rgb_turn(random_rotation(random));
  for (int degree = 0; degree <= 5; ++degree) {
    std::vector<float> set = as_floats(random_coefficients(degree, 12, random)),
                       out(set.size());  // 4 RGB sets
    rotate_rgb_sets(turn, degree, set, out);
    rotate_rgb_sets(turn, degree, set, set);
    EXPECT_EQ(set, out);
  }
}

TEST(ShRotationRgb, RefusesWhatIsNoRotation) {
  EXPECT_THROW(make_rgb_turn({{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}}), Error);
  EXPECT_THROW(make_rgb_turn({{Vec3{1, 0, 0}, Vec3{0, NAN, 0}, Vec3{0, 0, 1}}}), Error);
}

}  // namespace
}  // namespace welkin
