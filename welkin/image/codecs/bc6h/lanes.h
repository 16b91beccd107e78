#pragma once
#include <cstring>

// Sixteen numbers, one a texel (or one a partition, or one a palette entry), as two compiler vectors of eight: the same
// operations in the same order on every instruction set. The files that use them are built without contraction to
// fused multiply-adds, so a block has the same bytes on every machine. (Eight, because g++ 12 takes comparisons of
// longer vectors than the machine's apart into single numbers.)

namespace welkin::bc6h {

#define WELKIN_INLINE [[gnu::always_inline]] inline

using Floats8 [[gnu::vector_size(32)]] = float;
using Ints8 [[gnu::vector_size(32)]] = int;

struct IntLanes {
  Ints8 a{}, b{};
  int operator[](int i) const { return i < 8 ? a[i] : b[i - 8]; }
};

struct Lanes {
  Floats8 a{}, b{};
  float operator[](int i) const { return i < 8 ? a[i] : b[i - 8]; }
};

WELKIN_INLINE Lanes load(const float* values) {
  Lanes v;
  std::memcpy(&v.a, values, 32), std::memcpy(&v.b, values + 8, 32);
  return v;
}
WELKIN_INLINE IntLanes load(const int* values) {
  IntLanes v;
  std::memcpy(&v.a, values, 32), std::memcpy(&v.b, values + 8, 32);
  return v;
}
WELKIN_INLINE void store(const Lanes& v, float* values) {
  std::memcpy(values, &v.a, 32), std::memcpy(values + 8, &v.b, 32);
}
WELKIN_INLINE void store(const IntLanes& v, int* values) {
  std::memcpy(values, &v.a, 32), std::memcpy(values + 8, &v.b, 32);
}

WELKIN_INLINE Lanes broadcast(float value) { return {value - Floats8{}, value - Floats8{}}; }
WELKIN_INLINE IntLanes broadcast(int value) { return {value + Ints8{}, value + Ints8{}}; }

WELKIN_INLINE Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.b + y.b}; }
WELKIN_INLINE Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.b - y.b}; }
WELKIN_INLINE Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.b * y.b}; }
WELKIN_INLINE Lanes operator/(const Lanes& x, const Lanes& y) { return {x.a / y.a, x.b / y.b}; }
WELKIN_INLINE Lanes operator-(const Lanes& x, float y) { return {x.a - y, x.b - y}; }
WELKIN_INLINE Lanes operator+(const Lanes& x, float y) { return {x.a + y, x.b + y}; }
WELKIN_INLINE Lanes operator*(const Lanes& x, float y) { return {x.a * y, x.b * y}; }
WELKIN_INLINE IntLanes operator+(const IntLanes& x, const IntLanes& y) { return {x.a + y.a, x.b + y.b}; }
WELKIN_INLINE IntLanes operator*(const IntLanes& x, int y) { return {x.a * y, x.b * y}; }
WELKIN_INLINE IntLanes operator>>(const IntLanes& x, int y) { return {x.a >> y, x.b >> y}; }

WELKIN_INLINE Lanes select(const IntLanes& mask, const Lanes& x, const Lanes& y) {
  return {mask.a ? x.a : y.a, mask.b ? x.b : y.b};
}
WELKIN_INLINE IntLanes select(const IntLanes& mask, const IntLanes& x, const IntLanes& y) {
  return {mask.a ? x.a : y.a, mask.b ? x.b : y.b};
}
WELKIN_INLINE IntLanes operator<(const Lanes& x, const Lanes& y) { return {x.a < y.a, x.b < y.b}; }
WELKIN_INLINE Lanes minimum(const Lanes& x, const Lanes& y) { return select(x < y, x, y); }
WELKIN_INLINE Lanes maximum(const Lanes& x, const Lanes& y) { return select(x < y, y, x); }
WELKIN_INLINE Lanes magnitude(const Lanes& x) { return maximum(x, Lanes{} - x); }
WELKIN_INLINE IntLanes magnitude(const IntLanes& x) { return {x.a < 0 ? -x.a : x.a, x.b < 0 ? -x.b : x.b}; }

/// Pairs eight, four, two and one apart.
WELKIN_INLINE float sum(const Lanes& v) {
  const Floats8 s = v.a + v.b;
  const float p = s[0] + s[4], q = s[1] + s[5], r = s[2] + s[6], t = s[3] + s[7];
  return (p + r) + (q + t);
}

WELKIN_INLINE float smallest(const Lanes& v) {
  const Floats8 s = v.a < v.b ? v.a : v.b;
  float least = s[0];
  for (int i = 1; i < 8; ++i) least = s[i] < least ? s[i] : least;
  return least;
}

}  // namespace welkin::bc6h
