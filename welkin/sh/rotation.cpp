#include <welkin/sh/rotation.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/rotation_recurrence.h>

namespace welkin {
namespace {

constexpr double orthogonality_tolerance = 1e-6;

void check_degree(int max_degree) {
  if (max_degree < 0 || max_degree > max_rotation_degree)
    throw Error("rotations take degrees between 0 and " + std::to_string(max_rotation_degree) + ", not " +
                std::to_string(max_degree));
}

// False also for NaN and infinity.
bool is_orthogonal(const Mat3& r) {
  bool good = true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      good &= std::abs(dot(r.rows[i], r.rows[j]) - (i == j ? 1 : 0)) <= orthogonality_tolerance;
  return good;
}

// R (3 - R^T R)/2 as rows: row_i = 1.5 r_i - 0.5 sum over j of (r_i . r_j) r_j.
Mat3 newton_schulz_step(const Mat3& r) {
  Mat3 result;
  for (int i = 0; i < 3; ++i) {
    Vec3 sum = 1.5 * r.rows[i];
    for (int j = 0; j < 3; ++j) sum = sum - (0.5 * dot(r.rows[i], r.rows[j])) * r.rows[j];
    result.rows[i] = sum;
  }
  return result;
}

// The recurrence multiplies its rounding by about 500 between degree 32 and 64 (and hardly before), which is why larger
// degrees run in long double: orthogonal to 2e-14 at degree 64 then, to 2e-11 in double.
constexpr int last_degree_in_double = 24;

template <class Real>
std::vector<Real> blocks_of(const Mat3& rotation, int max_degree) {
  std::vector<Real> blocks(rotation::block_start(max_degree + 1)), reciprocals(2 * max_degree + 1);
  rotation::all_blocks(rotation, max_degree, blocks.data(), reciprocals.data());
  return blocks;
}

bool changes_sign(MirrorAxis axis, int l, int m) {
  switch (axis) {
    case MirrorAxis::x: return (m % 2 != 0) != (m < 0);  // azimuth to 180 degrees minus azimuth
    case MirrorAxis::y: return m < 0;                    // azimuth to minus azimuth
    case MirrorAxis::z: return (l + m) % 2 != 0;
  }
  return false;
}

}  // namespace

void check_rotation(const Mat3& rotation) {
  if (!is_orthogonal(rotation)) throw Error("the rotation matrix is not orthogonal");
  if (dot(rotation.rows[0], cross(rotation.rows[1], rotation.rows[2])) < 0)
    throw Error("the rotation matrix contains a mirror (its determinant is -1)");
}

Mat3 orthonormalized(const Mat3& rotation) {
  check_rotation(rotation);
  return newton_schulz_step(newton_schulz_step(rotation));
}

ShRotation make_sh_rotation(const Mat3& rotation, int max_degree) {
  check_degree(max_degree);
  const Mat3 orthogonal = orthonormalized(rotation);
  ShRotation result;
  result.max_degree = max_degree;
  if (max_degree <= last_degree_in_double) {
    result.blocks = blocks_of<double>(orthogonal, max_degree);
  } else {
    const std::vector<long double> blocks = blocks_of<long double>(orthogonal, max_degree);
    result.blocks.resize(blocks.size());
    std::transform(blocks.begin(), blocks.end(), result.blocks.begin(),
                   [](long double value) { return static_cast<double>(value); });
  }
  return result;
}

ShCoefficients rotate(const ShCoefficients& coefficients, const ShRotation& rotation) {
  check_coefficients(coefficients);
  if (coefficients.max_degree > rotation.max_degree)
    throw Error("coefficients of degree " + std::to_string(coefficients.max_degree) +
                " need more than rotation matrices of degree " + std::to_string(rotation.max_degree));
  const int channels = coefficients.channels;
  ShCoefficients result(coefficients.max_degree, channels);
  const double* matrix = rotation.blocks.data();
  for (int l = 0; l <= coefficients.max_degree; ++l) {
    const double* in = coefficients.values.data() + sh_index(l, -l) * channels;
    double* out = result.values.data() + sh_index(l, -l) * channels;
    for (int m = 0; m < 2 * l + 1; ++m)
      for (int n = 0; n < 2 * l + 1; ++n, ++matrix)
        for (int c = 0; c < channels; ++c) out[m * channels + c] += *matrix * in[n * channels + c];
  }
  return result;
}

ShCoefficients mirror(const ShCoefficients& coefficients, MirrorAxis axis) {
  check_coefficients(coefficients);
  ShCoefficients result = coefficients;
  for (int l = 0; l <= result.max_degree; ++l)
    for (int m = -l; m <= l; ++m)
      if (changes_sign(axis, l, m))
        for (int c = 0; c < result.channels; ++c) {
          double& value = result.values[sh_index(l, m) * result.channels + c];
          value = -value;
        }
  return result;
}

}  // namespace welkin
