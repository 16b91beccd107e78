#pragma once
#include <cstddef>
#include <span>
#include <string_view>

namespace welkin {

/// How many values of an image cannot be radiance.
struct PixelFaults {
  std::size_t nan = 0;
  std::size_t infinite = 0;  ///< of either sign
  std::size_t negative = 0;  ///< finite and below zero; -0 is not

  std::size_t total() const { return nan + infinite + negative; }
};

/// Counts values, not pixels.
PixelFaults count_faults(std::span<const float> values);

enum class FaultPolicy {
  repair,  ///< NaN, negative values and -infinity become 0, +infinity the largest finite value of the image
  refuse,  ///< any fault throws Error(name, ...) with the counts; the values stay as they are
  keep,    ///< only count
};

/// Counts the faults and treats them as the policy says; returns what was found before. `name` is for the message.
/// An image without any finite positive value repairs +infinity to 0.
PixelFaults repair_faults(std::span<float> values, FaultPolicy policy, std::string_view name);

}  // namespace welkin
