#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Whole numbers in files that store the lowest byte first.

namespace welkin {

inline void put_u32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

inline void put_u64(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  put_u32(bytes, static_cast<std::uint32_t>(value));
  put_u32(bytes, static_cast<std::uint32_t>(value >> 32));
}

/// The caller has checked that offset + 4 <= bytes.size().
inline std::uint32_t get_u32(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

/// The caller has checked that offset + 8 <= bytes.size().
inline std::uint64_t get_u64(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return get_u32(bytes, offset) | (static_cast<std::uint64_t>(get_u32(bytes, offset + 4)) << 32);
}

}  // namespace welkin
