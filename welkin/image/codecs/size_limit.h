#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace welkin {

/// The largest image that any reader accepts: 2^31 pixels (24 GiB as float RGB). Fuzzing builds (they define
/// FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION) stop at 2^18, so that no case is slow only because it is large.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr std::int64_t max_pixel_count = std::int64_t{1} << 18;
#else
inline constexpr std::int64_t max_pixel_count = std::int64_t{1} << 31;
#endif

/// To be called by a reader before it takes memory for width x height pixels that a header promises.
/// `byte_count` is the size of the whole file, `pixels_per_byte` the most that the format's best compression
/// can possibly hold. Throws Error(name, ...) when a side is < 1, the product is above max_pixel_count, or
/// the file is too short for it.
void check_image_size(std::string_view name, std::int64_t width, std::int64_t height, std::size_t byte_count,
                      double pixels_per_byte);

}  // namespace welkin
