#pragma once
#include <array>
#include <cstddef>
#include <span>

#include <welkin/sh/basis.h>
#include <welkin/sphere/mat3.h>

// Rotation of small RGB sets in floats, for every probe and every frame: degrees 0 to 5, three channels interleaved as
// files and engines hold them, sh_count(degree) * 3 floats without padding. Convention of rotation.h. Error below 1e-6
// of the largest coefficient. The vectorised and the scalar versions differ by rounding only.

namespace welkin {

inline constexpr int max_rgb_rotation_degree = 5;

/// Floats in an RGB set.
constexpr std::size_t sh_rgb_size(int max_degree) { return 3 * sh_count(max_degree); }

/// Cosines and sines of m a, m b, m c for R = Z(a) Y(b) Z(c): all that a rotation matrix is used for.
struct RgbTurn {
  std::array<float, max_rgb_rotation_degree + 1> cos_a, sin_a, cos_b, sin_b, cos_c, sin_c;
};

/// Throws Error unless the matrix is finite, orthogonal to 1e-6 and proper.
RgbTurn make_rgb_turn(const Mat3& rotation);

/// Rotates one set; in and out hold sh_rgb_size(max_degree) floats, 0 <= max_degree <= max_rgb_rotation_degree, and are the
/// same or do not overlap.
void rotate_rgb(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out);
void rotate_rgb(const Mat3& rotation, int max_degree, std::span<const float> in, std::span<float> out);

/// Rotates sets that follow each other, all by the same turn: in.size() is a multiple of sh_rgb_size(max_degree).
void rotate_rgb_sets(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out);

/// The same as rotate_rgb in plain loops: what the fast versions are tested against.
void rotate_rgb_scalar(const RgbTurn& turn, int max_degree, std::span<const float> in, std::span<float> out);

}  // namespace welkin
