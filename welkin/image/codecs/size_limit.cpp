#include <welkin/image/codecs/size_limit.h>

#include <fmt/format.h>

#include <limits>

#include <welkin/error.h>

namespace welkin {

void check_image_size(std::string_view name, std::int64_t width, std::int64_t height, std::size_t byte_count,
                      double pixels_per_byte) {
  constexpr std::int64_t max_side = std::numeric_limits<std::int32_t>::max();
  if (width < 1 || height < 1) {
    throw Error(name, fmt::format("the header gives a size of {} x {}; there are no pixels", width, height));
  }
  if (width > max_side || height > max_side || width > max_pixel_count / height) {
    throw Error(name, fmt::format("the header gives a size of {} x {}; at most {} pixels are accepted", width,
                                  height, max_pixel_count));
  }
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  if (pixels > pixels_per_byte * static_cast<double>(byte_count)) {
    throw Error(name,
                fmt::format("the header gives a size of {} x {}, but {} bytes cannot hold that; the file is "
                            "truncated or damaged",
                            width, height, byte_count));
  }
}

}  // namespace welkin
