#pragma once
#include <vector>

#include <welkin/sh/projection.h>

namespace welkin {

/// The factors A_l of the clamped-cosine kernel max(0, cos theta), l = 0 .. max_degree: pi, 2 pi/3, pi/4, 0, -pi/24,
/// ... irradiance_lm = A_l radiance_lm (Ramamoorthi & Hanrahan 2001, equations 7-9).
std::vector<double> cosine_lobe(int max_degree);

/// Multiplies degree l by factors[l] (Funk-Hecke); degrees beyond factors.size() become 0.
ShCoefficients convolve(const ShCoefficients& coefficients, std::span<const double> factors);

}  // namespace welkin
