#pragma once
#include <algorithm>

namespace welkin {

/// A linear Rec. 709 colour or one number a channel: radiance, throughput, albedo, as the name says.
struct Rgb {
  float r = 0, g = 0, b = 0;
};

constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(float s, Rgb a) { return {s * a.r, s * a.g, s * a.b}; }
constexpr Rgb& operator+=(Rgb& a, Rgb b) { return a = a + b; }
constexpr Rgb& operator*=(Rgb& a, Rgb b) { return a = a * b; }
constexpr bool is_black(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
constexpr float max_channel(Rgb a) { return std::max({a.r, a.g, a.b}); }
/// Rec. 709 luminance.
constexpr float luminance(Rgb a) { return 0.2126f * a.r + 0.7152f * a.g + 0.0722f * a.b; }

}  // namespace welkin
