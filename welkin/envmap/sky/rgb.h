#pragma once
#include <algorithm>
#include <array>

namespace welkin {

/// Three colour channels, linear Rec.709 (or CIE XYZ where the name says so).
using Rgb = std::array<double, 3>;

constexpr Rgb operator+(Rgb a, Rgb b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
constexpr Rgb operator*(double s, Rgb a) { return {s * a[0], s * a[1], s * a[2]}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// Relative luminance Y of linear Rec.709.
constexpr double luminance(Rgb c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

/// CIE 1931 XYZ to linear Rec.709 (D65 white, IEC 61966-2-1), with colours outside the gamut cut to >= 0.
constexpr Rgb rec709_from_xyz(Rgb xyz) {
  const Rgb rgb{3.2406 * xyz[0] - 1.5372 * xyz[1] - 0.4986 * xyz[2],
                -0.9689 * xyz[0] + 1.8758 * xyz[1] + 0.0415 * xyz[2],
                0.0557 * xyz[0] - 0.2040 * xyz[1] + 1.0570 * xyz[2]};
  return {std::max(rgb[0], 0.0), std::max(rgb[1], 0.0), std::max(rgb[2], 0.0)};
}

/// XYZ of a colour with chromaticity (x, y) and luminance `Y`; y > 0.
constexpr Rgb xyz_from_chromaticity(double x, double y, double luminance_Y) {
  return {x / y * luminance_Y, luminance_Y, (1 - x - y) / y * luminance_Y};
}

}  // namespace welkin
