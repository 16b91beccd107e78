#include <algorithm>
#include <array>
#include <cmath>

#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/rotation_recurrence.h>

// A turn about z by a takes f(phi) to f(phi - a), so with the pair (c_m, c_-m) of cos m phi and sin m phi
//   c'_m = c_m cos ma - c_-m sin ma,   c'_-m = c_m sin ma + c_-m cos ma.
// Y(b) = X(-90) Z(b) X(90), because X(-90) takes the z axis to y. X(-90) = X(180) X(90) is the same constant matrix
// followed by the signs of a half turn.

namespace welkin {
namespace {

// The non-zero entries of the quarter turns about x, rows of rotation::quarter_turn_columns one after the other.
struct QuarterTurns {
  std::vector<double> values;

  explicit QuarterTurns(int degree) {
    std::vector<long double> dense(rotation::block_start(degree + 1)), reciprocals(2 * degree + 1);
    rotation::all_blocks(rotation::quarter_turn_x, degree, dense.data(), reciprocals.data());
    for (int l = 0; l <= degree; ++l)
      for (int m = -l; m <= l; ++m) {
        const auto columns = rotation::quarter_turn_columns(l, m);
        for (int k = 0; k < columns.count; ++k)
          values.push_back(static_cast<double>(
              dense[rotation::block_start(l) + (m + l) * (2 * l + 1) + columns.first + 2 * k]));
      }
  }
};

// Small sets do not pay for the constants of large ones.
const QuarterTurns& quarter_turns(int degree) {
  constexpr int small_degree = 10;
  static const QuarterTurns small(small_degree);
  if (degree <= small_degree) return small;
  static const QuarterTurns large(max_rotation_degree);
  return large;
}

struct Multiples {
  std::array<double, max_rotation_degree + 1> cosine, sine;

  // By the addition theorems: the error of step m grows as m roundings do.
  Multiples(double cos_1, double sin_1, int count) {
    cosine[0] = 1;
    sine[0] = 0;
    for (int m = 1; m <= count; ++m) {
      cosine[m] = cosine[m - 1] * cos_1 - sine[m - 1] * sin_1;
      sine[m] = sine[m - 1] * cos_1 + cosine[m - 1] * sin_1;
    }
  }
};

// Channels: how many are interleaved, so that loops over them unroll; 0 where `channels` says it at run time.
// block: the 2l+1 coefficients of degree l.
template <int Channels>
void turn_about_z(int l, int channels, const Multiples& angle, double* block) {
  if (Channels > 0) channels = Channels;
  for (int m = 1; m <= l; ++m) {
    double *plus = block + (l + m) * channels, *minus = block + (l - m) * channels;
    for (int c = 0; c < channels; ++c) {
      const double p = plus[c], q = minus[c];
      plus[c] = p * angle.cosine[m] - q * angle.sine[m];
      minus[c] = p * angle.sine[m] + q * angle.cosine[m];
    }
  }
}

// Returns where the values of the next degree begin.
template <int Channels>
const double* quarter_turn(int l, int channels, const double* values, const double* in, double* out) {
  if (Channels > 0) channels = Channels;
  for (int m = -l; m <= l; ++m) {
    double local[Channels > 0 ? Channels : 1] = {};
    double* sum = Channels > 0 ? local : std::fill_n(out + (l + m) * channels, channels, 0.0) - channels;
    const auto columns = rotation::quarter_turn_columns(l, m);
    const double* from = in + columns.first * channels;
    for (int k = 0; k < columns.count; ++k, from += 2 * channels, ++values)
      for (int c = 0; c < channels; ++c) sum[c] += *values * from[c];
    if (Channels > 0) std::copy_n(sum, channels, out + (l + m) * channels);
  }
  return values;
}

void half_turn(int l, int channels, double* block) {
  for (int m = -l; m <= l; ++m)
    for (int c = 0; c < channels; ++c) block[(l + m) * channels + c] *= rotation::half_turn_x_sign(l, m);
}

template <int Channels>
void turn_all(const Multiples& a, const Multiples& b, const Multiples& c, ShCoefficients& set) {
  const int channels = set.channels;
  std::vector<double> turned(static_cast<std::size_t>(2 * set.max_degree + 1) * channels);
  const double* values = quarter_turns(set.max_degree).values.data();
  for (int l = 0; l <= set.max_degree; ++l) {
    double* block = set.values.data() + sh_index(l, -l) * channels;
    turn_about_z<Channels>(l, channels, c, block);
    quarter_turn<Channels>(l, channels, values, block, turned.data());
    turn_about_z<Channels>(l, channels, b, turned.data());
    values = quarter_turn<Channels>(l, channels, values, turned.data(), block);
    half_turn(l, channels, block);
    turn_about_z<Channels>(l, channels, a, block);
  }
}

}  // namespace

ZyzTurn zyz_turn(const Mat3& rotation) {
  const auto& [x, y, z] = rotation.rows;
  ZyzTurn turn;
  const double sin_b = std::sqrt(x.z * x.z + y.z * y.z);
  if (sin_b > 0) turn.cos_a = x.z / sin_b, turn.sin_a = y.z / sin_b;
  const double length_a = std::sqrt(turn.cos_a * turn.cos_a + turn.sin_a * turn.sin_a);
  turn.cos_a /= length_a;
  turn.sin_a /= length_a;
  // What is left after Z(-a): Y(b) Z(c), whose second row is (sin c, cos c, 0).
  turn.sin_c = turn.cos_a * y.x - turn.sin_a * x.x;
  turn.cos_c = turn.cos_a * y.y - turn.sin_a * x.y;
  const double length_b = std::sqrt(sin_b * sin_b + z.z * z.z);
  const double length_c = std::sqrt(turn.sin_c * turn.sin_c + turn.cos_c * turn.cos_c);
  turn.sin_b = sin_b / length_b, turn.cos_b = z.z / length_b;
  turn.sin_c /= length_c, turn.cos_c /= length_c;
  return turn;
}

ShCoefficients rotate(const ShCoefficients& coefficients, const Mat3& rotation) {
  check_coefficients(coefficients);
  if (coefficients.max_degree > max_rotation_degree)
    throw Error("rotations take degrees up to " + std::to_string(max_rotation_degree) + ", not " +
                std::to_string(coefficients.max_degree));
  const ZyzTurn turn = zyz_turn(orthonormalized(rotation));
  const int degree = coefficients.max_degree;
  const Multiples a(turn.cos_a, turn.sin_a, degree), b(turn.cos_b, turn.sin_b, degree),
      c(turn.cos_c, turn.sin_c, degree);
  ShCoefficients result = coefficients;
  switch (result.channels) {
    case 1: turn_all<1>(a, b, c, result); break;
    case 3: turn_all<3>(a, b, c, result); break;
    case 4: turn_all<4>(a, b, c, result); break;
    default: turn_all<0>(a, b, c, result);
  }
  return result;
}

}  // namespace welkin
