#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/brdf/isotropic.h>

// Measured isotropic BRDFs in the layout of the MERL database (Matusik et al. 2003). A file is three int32 (cells of
// theta_half, theta_diff, phi_diff: 90, 90, 180 in the database), then the red, the green and the blue plane, doubles,
// phi_diff fastest and theta_half slowest, all little-endian; value * (1, 1.15, 1.66) / 1500 is the BRDF, per steradian.
// Angles are those of Rusinkiewicz 1998: of the half vector from the normal, and of the light about the half vector.
//   theta_half = pi/2 (i / n)^2, finer towards the peak; theta_diff = pi/2 j / n; phi_diff = pi k / n (f is reciprocal).
// Cell i covers [i, i + 1), as the database's own reader has it. Negative values mark what could not be measured.

namespace welkin {

struct MerlShape {
  int theta_half = 90, theta_diff = 90, phi_diff = 180;

  std::size_t cells() const { return static_cast<std::size_t>(theta_half) * theta_diff * phi_diff; }
};

/// A table as it is in a file, but scaled: values[(channel * cells) + cell] are the BRDF; negative where invalid.
struct MerlTable {
  MerlShape shape;
  std::vector<float> values;
};

/// Reads a file's bytes. Other shapes than the database's are taken, 1 to 1024 cells an angle, as long as the bytes are
/// exactly as many as the shape says. Throws Error that begins with `name` for anything else, and for values that are
/// not finite or above 1e30.
MerlTable read_merl(std::span<const std::uint8_t> bytes, std::string_view name);

/// The bytes of a file; read_merl gives the table back to the precision of floats. Invalid cells are written as -1.
std::vector<std::uint8_t> encode_merl(const MerlTable& table);

/// A BRDF at the centres of all cells; cells whose light or view lies below the surface are invalid (-1).
MerlTable tabulate_merl(const IsotropicBrdf& brdf, const MerlShape& shape = {});

/// The table as a BRDF: trilinear between the centres of cells, periodic in phi_diff and clamped in the others. Invalid
/// cells take no part (the others' weights grow to 1); 0 where all eight are invalid. phi_diff and pi - phi_diff are
/// averaged first: what no surface without a handedness can tell apart, and what makes the BRDF reciprocal exactly.
/// `name` is for reports.
IsotropicBrdf make_merl_brdf(const MerlTable& table, std::string_view name);

}  // namespace welkin
