#include <welkin/image/codecs/ldr.h>

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <memory>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/image/srgb.h>

namespace welkin {
namespace {

constexpr std::array<std::uint8_t, 8> png_magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> jpeg_magic{0xff, 0xd8, 0xff};

template <std::size_t Count>
bool starts_with(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, Count>& magic) {
  return bytes.size() >= Count && std::equal(magic.begin(), magic.end(), bytes.begin());
}

// A JPEG that is cut off decodes without complaint, the rest gray. So follow the segments (marker, length) up
// to the first scan and ask for an end-of-image marker behind it; segments before it may hold thumbnails with
// their own.
void check_jpeg_is_whole(std::span<const std::uint8_t> bytes, std::string_view name) {
  constexpr std::uint8_t start_of_scan = 0xda, end_of_image = 0xd9;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == 0xff && bytes[at + 1] != start_of_scan) {
    const bool fill = bytes[at + 1] == 0xff;
    at += fill ? 1 : std::size_t{2} + (bytes[at + 2] << 8 | bytes[at + 3]);
  }
  for (; at + 2 <= bytes.size(); ++at) {
    if (bytes[at] == 0xff && bytes[at + 1] == end_of_image) return;
  }
  throw Error(name, "this JPEG is cut off: it has no end-of-image marker");
}

// stb takes memory for a chunk by the length it gives. So follow the chunks (length, type, data, check sum) to the end.
void check_png_is_whole(std::span<const std::uint8_t> bytes, std::string_view name) {
  constexpr std::array<std::uint8_t, 4> end_type{'I', 'E', 'N', 'D'};
  std::size_t at = png_magic.size();
  while (at + 12 <= bytes.size()) {
    const auto head = bytes.subspan(at);
    const std::size_t length =
        std::size_t{head[0]} << 24 | std::size_t{head[1]} << 16 | std::size_t{head[2]} << 8 | head[3];
    if (length > head.size() - 12) break;
    if (starts_with(head.subspan(4), end_type)) return;
    at += 12 + length;
  }
  throw Error(name, "this PNG is cut off or damaged: its chunks do not lead to an end chunk");
}

struct StbFree {
  void operator()(void* memory) const { stbi_image_free(memory); }
};

template <class Sample>
Image to_linear(const Sample* samples, int width, int height) {
  constexpr std::size_t count = std::size_t{std::numeric_limits<Sample>::max()} + 1;
  std::vector<float> table(count);
  for (std::size_t i = 0; i < count; ++i) {
    table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  Image image(width, height);
  std::transform(samples, samples + image.pixels.size(), image.pixels.begin(),
                 [&](Sample s) { return table[s]; });
  return image;
}

[[noreturn]] void fail(std::string_view name, std::string_view format) {
  const char* reason = stbi_failure_reason();
  throw Error(name, "cannot read this " + std::string(format) + ": " + (reason ? reason : "it is damaged"));
}

void check_size(std::span<const std::uint8_t> bytes, std::string_view name, std::string_view format,
                bool png) {
  int width = 0, height = 0, channels = 0;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw Error(name, "PNG and JPEG files are read up to 2 GiB");
  }
  if (!stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels)) {
    fail(name, format);
  }
  // Deflate ends at 1032 : 1 and a PNG pixel can be one bit. A block of 8 x 8 JPEG pixels takes a bit or
  // more.
  check_image_size(name, width, height, bytes.size(), png ? 8 * 1032 : 8 * 64);
}

Image decode_pixels(std::span<const std::uint8_t> bytes, std::string_view name, std::string_view format) {
  const auto size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_is_16_bit_from_memory(bytes.data(), size)) {
    const std::unique_ptr<stbi_us, StbFree> samples(
        stbi_load_16_from_memory(bytes.data(), size, &width, &height, &channels, 3));
    return samples ? to_linear(samples.get(), width, height) : (fail(name, format), Image());
  }
  const std::unique_ptr<stbi_uc, StbFree> samples(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 3));
  return samples ? to_linear(samples.get(), width, height) : (fail(name, format), Image());
}

}  // namespace

LoadedImage decode_ldr(std::span<const std::uint8_t> bytes, std::string_view name) {
  const bool png = starts_with(bytes, png_magic), jpeg = starts_with(bytes, jpeg_magic);
  if (!png && !jpeg) throw Error(name, "neither a PNG nor a JPEG file");
  LoadedImage loaded;
  loaded.format = png ? "PNG" : "JPEG";
  png ? check_png_is_whole(bytes, name) : check_jpeg_is_whole(bytes, name);
  check_size(bytes, name, loaded.format, png);
  loaded.flat = decode_pixels(bytes, name, loaded.format);
  loaded.warnings.push_back(loaded.format + " is not HDR: light above white is lost");
  return loaded;
}

}  // namespace welkin
