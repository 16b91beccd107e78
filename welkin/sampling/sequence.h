#pragma once
#include <array>
#include <cstdint>

// Low-discrepancy points in the unit square [0, 1)^2: they cover it more evenly than random points do, so averages
// over them converge at about 1/n instead of 1/sqrt(n).

namespace welkin {

/// A point of the unit square; each coordinate in [0, 1).
using Point2 = std::array<double, 2>;

/// Point `index` of the R2 sequence (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"): the
/// multiples of (1/g, 1/g^2) modulo 1, with g the real root of g^3 = g + 1. Extensible: any prefix is well spread.
/// `seed` shifts the whole sequence on the torus; seed 0 is the sequence as published, centred at (1/2, 1/2).
Point2 r2_point(std::uint64_t index, std::uint64_t seed = 0);

/// The digits of `index` in base 2, mirrored at the binary point (van der Corput 1935). In [0, 1).
double radical_inverse_base2(std::uint64_t index);

/// Point `index` of the Hammersley set of `count` points, (index / count, radical inverse of index in base 2)
/// (Hammersley 1960). Needs index < count.
Point2 hammersley_point(std::uint64_t index, std::uint64_t count);

/// Mixes 64 bits: a bijection whose outputs for consecutive inputs look independent (SplitMix64, Steele, Lea and
/// Flood 2014). For seeds, not for secrets.
std::uint64_t mix_bits(std::uint64_t value);

}  // namespace welkin
