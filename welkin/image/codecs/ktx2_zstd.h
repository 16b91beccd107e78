#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

// Zstandard supercompression of the levels of KTX2 files: ktx2_zstd.cpp by the zstd library, ktx2_zstd_absent.cpp where
// there is none (the web build). Private to the KTX2 reader and writer.

namespace welkin {

/// zstd_level: 1 (fast) to 22 (small). Throws Error where there is no zstd.
std::vector<std::uint8_t> compress_ktx2_level(std::span<const std::uint8_t> bytes, int zstd_level);

/// The `expected` bytes of a level. Throws Error naming `name` when the frame does not hold just as many, before memory
/// is taken for them, and where there is no zstd.
std::vector<std::uint8_t> decompress_ktx2_level(std::span<const std::uint8_t> stored, std::size_t expected,
                                                std::size_t level, std::string_view name);

}  // namespace welkin
