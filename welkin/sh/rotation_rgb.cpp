#include <welkin/sh/rotation_rgb.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include <welkin/parallel/target_clones.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/rotation_recurrence.h>

// Z(a) X(-90) Z(b) X(90) Z(c) as in rotation_zxzxz.cpp. The quarter turns have 71 non-zero entries to degree 5; they are
// compile-time constants and the loops over them are unrolled by templates, so a set costs about 330 multiply-adds of
// vectors and no look-ups. A vector holds one coefficient: its red, green and blue and, unpadded as the set is, the red
// of the next one, which the next store overwrites. (Four sets at once in vectors
// of 16 are no faster: gathering and scattering them costs what the wider arithmetic saves.)

#define WELKIN_INLINE inline __attribute__((always_inline))

namespace welkin {
namespace {

constexpr int top_degree = max_rgb_rotation_degree;

using One = float __attribute__((vector_size(16)));

constexpr std::array<double, rotation::block_start(top_degree + 1)> make_quarter_turn_blocks() {
  std::array<double, rotation::block_start(top_degree + 1)> blocks{};
  std::array<double, 2 * top_degree + 1> reciprocals{};
  rotation::all_blocks(rotation::quarter_turn_x, top_degree, blocks.data(), reciprocals.data());
  return blocks;
}
constexpr auto quarter_turn_blocks = make_quarter_turn_blocks();

constexpr bool is_entry(int l, int a, int b) {
  const auto columns = rotation::quarter_turn_columns(l, a - l);
  return b >= columns.first && b < columns.first + 2 * columns.count && (b - columns.first) % 2 == 0;
}
constexpr float entry(int l, int a, int b) {
  return is_entry(l, a, b)
             ? static_cast<float>(quarter_turn_blocks[rotation::block_start(l) + a * (2 * l + 1) + b])
             : 0.0f;
}

constexpr std::array<float, rotation::block_start(top_degree + 1)> make_entries() {
  std::array<float, rotation::block_start(top_degree + 1)> entries{};
  std::size_t i = 0;
  for (int l = 0; l <= top_degree; ++l)
    for (int a = 0; a < 2 * l + 1; ++a)
      for (int b = 0; b < 2 * l + 1; ++b) entries[i++] = entry(l, a, b);
  return entries;
}
constexpr auto entries = make_entries();

// Adds the product for column B of row A, if it is not 0. X(-90) is the transpose of X(90).
template <int L, bool Transposed, int A, int B, class Vector>
WELKIN_INLINE void add_product(const Vector* in, Vector& sum) {
  constexpr float factor = Transposed ? entry(L, B, A) : entry(L, A, B);
  if constexpr (factor != 0) sum += factor * in[B];
}

template <int L, bool Transposed, int A, class Vector, std::size_t... B>
WELKIN_INLINE void quarter_turn_row(const Vector* in, Vector* out, std::index_sequence<B...>) {
  Vector sum{};
  (add_product<L, Transposed, A, static_cast<int>(B)>(in, sum), ...);
  out[A] = sum;
}

template <int L, bool Transposed, class Vector, std::size_t... A>
WELKIN_INLINE void quarter_turn(const Vector* in, Vector* out, std::index_sequence<A...> all) {
  (quarter_turn_row<L, Transposed, static_cast<int>(A)>(in, out, all), ...);
}

template <int L, int M, class Vector>
WELKIN_INLINE void turn_pair(const float* cosine, const float* sine, Vector* v) {
  const Vector p = v[L + M], q = v[L - M];
  v[L + M] = cosine[M] * p - sine[M] * q;
  v[L - M] = sine[M] * p + cosine[M] * q;
}

template <int L, class Vector, std::size_t... M>
WELKIN_INLINE void turn_about_z(const float* cosine, const float* sine, Vector* v,
                                std::index_sequence<M...>) {
  (turn_pair<L, static_cast<int>(M) + 1>(cosine, sine, v), ...);
}

// v: the 2 L + 1 coefficients of degree L.
template <int L, class Vector>
WELKIN_INLINE void turn_degree(const RgbTurn& turn, Vector* v) {
  constexpr std::make_index_sequence<2 * L + 1> rows{};
  constexpr std::make_index_sequence<L> orders{};
  Vector w[2 * L + 1];
  turn_about_z<L>(turn.cos_c.data(), turn.sin_c.data(), v, orders);
  quarter_turn<L, false>(v, w, rows);
  turn_about_z<L>(turn.cos_b.data(), turn.sin_b.data(), w, orders);
  quarter_turn<L, true>(w, v, rows);
  turn_about_z<L>(turn.cos_a.data(), turn.sin_a.data(), v, orders);
}

// The last coefficient of a degree is read with the float before it and written without the one after it, so nothing
// outside the set is touched, and sets may be rotated in place.
template <int L>
WELKIN_INLINE void load(const float* set, One* v) {
  for (int k = 0; k < 2 * L; ++k) std::memcpy(&v[k], set + 3 * (L * L + k), sizeof(One));
  One shifted;
  std::memcpy(&shifted, set + 3 * (L * L + 2 * L) - 1, sizeof shifted);
  v[2 * L] = __builtin_shufflevector(shifted, shifted, 1, 2, 3, 3);
}

template <int L>
WELKIN_INLINE void store(const One* v, float* set) {
  for (int k = 0; k < 2 * L; ++k) std::memcpy(set + 3 * (L * L + k), &v[k], sizeof(One));
  std::memcpy(set + 3 * (L * L + 2 * L), &v[2 * L], 3 * sizeof(float));
}

template <int L>
WELKIN_INLINE void rotate_degree(const RgbTurn& turn, const float* in, float* out) {
  One v[2 * L + 1];
  load<L>(in, v);
  turn_degree<L>(turn, v);
  store<L>(v, out);
}

WELKIN_TARGET_CLONES void rotate_sets(const RgbTurn& turn, int max_degree, std::size_t sets, const float* in,
                                      float* out) {
  for (; sets > 0; --sets) {
    std::memmove(out, in, 3 * sizeof(float));
    if (max_degree >= 1) rotate_degree<1>(turn, in, out);
    if (max_degree >= 2) rotate_degree<2>(turn, in, out);
    if (max_degree >= 3) rotate_degree<3>(turn, in, out);
    if (max_degree >= 4) rotate_degree<4>(turn, in, out);
    if (max_degree >= 5) rotate_degree<5>(turn, in, out);
    in += sh_rgb_size(max_degree);
    out += sh_rgb_size(max_degree);
  }
}

using Multiples = std::array<float, top_degree + 1>;

// In double, by the addition theorems, so that the floats are rounded once.
void set_multiples(double cos_1, double sin_1, Multiples& cosine, Multiples& sine) {
  double c = 1, s = 0;
  for (int m = 0; m <= top_degree; ++m) {
    cosine[m] = static_cast<float>(c);
    sine[m] = static_cast<float>(s);
    const double next = c * cos_1 - s * sin_1;
    s = s * cos_1 + c * sin_1;
    c = next;
  }
}

void turn_about_z_scalar(int l, const Multiples& cosine, const Multiples& sine, float* block) {
  for (int m = 1; m <= l; ++m)
    for (int c = 0; c < 3; ++c) {
      float &p = block[3 * (l + m) + c], &q = block[3 * (l - m) + c];
      const float turned = cosine[m] * p - sine[m] * q;
      q = sine[m] * p + cosine[m] * q;
      p = turned;
    }
}

void quarter_turn_scalar(int l, bool transposed_turn, float* block) {
  const float* matrix = entries.data() + rotation::block_start(l);
  float turned[3 * (2 * top_degree + 1)] = {};
  for (int a = 0; a < 2 * l + 1; ++a)
    for (int b = 0; b < 2 * l + 1; ++b)
      for (int c = 0; c < 3; ++c)
        turned[3 * a + c] +=
            matrix[transposed_turn ? b * (2 * l + 1) + a : a * (2 * l + 1) + b] * block[3 * b + c];
  std::copy_n(turned, 3 * (2 * l + 1), block);
}

[[maybe_unused]] bool sizes_fit(int max_degree, std::span<const float> in, std::span<float> out) {
  return max_degree >= 0 && max_degree <= top_degree && in.size() == out.size() &&
         in.size() % sh_rgb_size(max_degree) == 0;
}

}  // namespace

RgbTurn make_rgb_turn(const Mat3& rotation) {
  check_rotation(rotation);
  const ZyzTurn angles = zyz_turn(rotation);
  RgbTurn turn;
  set_multiples(angles.cos_a, angles.sin_a, turn.cos_a, turn.sin_a);
  set_multiples(angles.cos_b, angles.sin_b, turn.cos_b, turn.sin_b);
  set_multiples(angles.cos_c, angles.sin_c, turn.cos_c, turn.sin_c);
  return turn;
}

void rotate_rgb(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out) {
  assert(sizes_fit(max_degree, in, out) && in.size() == sh_rgb_size(max_degree));
  rotate_sets(turn, max_degree, 1, in.data(), out.data());
}

void rotate_rgb(const Mat3& rotation, int max_degree, std::span<const float> in, std::span<float> out) {
  rotate_rgb(make_rgb_turn(rotation), max_degree, in, out);
}

void rotate_rgb_sets(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out) {
  assert(sizes_fit(max_degree, in, out));
  rotate_sets(turn, max_degree, in.size() / sh_rgb_size(max_degree), in.data(), out.data());
}

void rotate_rgb_scalar(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out) {
  assert(sizes_fit(max_degree, in, out) && in.size() == sh_rgb_size(max_degree));
  if (out.data() != in.data()) std::copy(in.begin(), in.end(), out.begin());
  for (int l = 1; l <= max_degree; ++l) {
    float* block = out.data() + 3 * l * l;
    turn_about_z_scalar(l, turn.cos_c, turn.sin_c, block);
    quarter_turn_scalar(l, false, block);
    turn_about_z_scalar(l, turn.cos_b, turn.sin_b, block);
    quarter_turn_scalar(l, true, block);
    turn_about_z_scalar(l, turn.cos_a, turn.sin_a, block);
  }
}

}  // namespace welkin
