#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <welkin/image/image.h>

namespace welkin {

/// A PNG of two cubes of one size as crosses beside each other, tone-mapped alike by the first one's exposure: the truth, the result, and the size
/// of their difference, times difference_gain, each under its caption.
std::vector<std::uint8_t> draw_beside(const Cube& truth, const Cube& result, const std::string& caption);

inline constexpr float difference_gain = 4;

}  // namespace welkin
