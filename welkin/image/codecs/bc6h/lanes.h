#pragma once

// Sixteen numbers, one a texel (or one a partition), as compilers' vector types: the same operations in the same
// order on every instruction set. The files that use them are built without contraction to fused multiply-adds, so a
// block has the same bytes on every machine.

namespace welkin::bc6h {

using Lanes [[gnu::vector_size(64)]] = float;
using IntLanes [[gnu::vector_size(64)]] = int;

[[gnu::always_inline]] inline Lanes broadcast(float value) { return value - Lanes{}; }

[[gnu::always_inline]] inline float sum(const Lanes& v) {
  float part[8];
  for (int i = 0; i < 8; ++i) part[i] = v[i] + v[i + 8];
  for (int i = 0; i < 4; ++i) part[i] += part[i + 4];
  return (part[0] + part[2]) + (part[1] + part[3]);
}

[[gnu::always_inline]] inline Lanes minimum(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Lanes maximum(const Lanes& a, const Lanes& b) { return a < b ? b : a; }

[[gnu::always_inline]] inline float smallest(const Lanes& v) {
  float part[8];
  for (int i = 0; i < 8; ++i) part[i] = v[i] < v[i + 8] ? v[i] : v[i + 8];
  for (int i = 0; i < 4; ++i) part[i] = part[i] < part[i + 4] ? part[i] : part[i + 4];
  const float a = part[0] < part[2] ? part[0] : part[2], b = part[1] < part[3] ? part[1] : part[3];
  return a < b ? a : b;
}

}  // namespace welkin::bc6h
