#pragma once
#include <string_view>
#include <vector>

#include <welkin/sh/projection.h>

// Linear algebra of coefficient sets. Every function here takes sets as they come from files and from users: it throws
// Error where a set is malformed (see check_coefficients) or where sizes or channels do not match.

namespace welkin {

/// Throws Error, naming `what`, unless max_degree >= 0, channels >= 1 and values.size() is what they ask for.
void check_coefficients(const ShCoefficients& coefficients, std::string_view what = "coefficients");

/// a + b. Same degree and channels.
ShCoefficients add(const ShCoefficients& a, const ShCoefficients& b);

/// factor * a.
ShCoefficients scale(const ShCoefficients& a, double factor);

/// One factor a channel; factors.size() = channels.
ShCoefficients scale(const ShCoefficients& a, std::span<const double> factors);

/// (1 - t) a + t b, exactly a at t = 0 and b at t = 1; t may lie outside [0, 1]. Same degree and channels.
ShCoefficients blend(const ShCoefficients& a, const ShCoefficients& b, double t);

/// The same function to another degree >= 0: higher degrees are cut off, missing ones are 0.
ShCoefficients resize(const ShCoefficients& a, int max_degree);

/// The integral of f g over the sphere, one per channel: by Parseval's theorem the sum of the products of the
/// coefficients, since the basis is orthonormal. Degrees may differ (the missing ones are 0), channels may not.
std::vector<double> inner_product(const ShCoefficients& a, const ShCoefficients& b);

}  // namespace welkin
