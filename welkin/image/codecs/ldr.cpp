#include <welkin/image/codecs/ldr.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr_samples.h>
#include <welkin/image/srgb.h>

namespace welkin {
namespace {

constexpr std::array<std::uint8_t, 8> png_magic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<std::uint8_t, 3> jpeg_magic{0xff, 0xd8, 0xff};

template <std::size_t Count>
bool starts_with(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, Count>& magic) {
  return bytes.size() >= Count && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::vector<float> linear_values(std::size_t count) {
  std::vector<float> table(count);
  for (std::size_t i = 0; i < count; ++i) {
    table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  return table;
}

Image to_linear(const LdrSamples& samples) {
  Image image(samples.width, samples.height);
  const std::uint8_t* bytes = samples.bytes.data();
  if (samples.bits == 16) {
    static const std::vector<float> table = linear_values(65536);
    for (float& pixel : image.pixels) {
      pixel = table[static_cast<std::size_t>(bytes[0] << 8 | bytes[1])];
      bytes += 2;
    }
  } else {
    static const std::vector<float> table = linear_values(256);
    for (float& pixel : image.pixels) pixel = table[*bytes++];
  }
  return image;
}

}  // namespace

LoadedImage decode_ldr(std::span<const std::uint8_t> bytes, std::string_view name) {
  const bool png = starts_with(bytes, png_magic), jpeg = starts_with(bytes, jpeg_magic);
  if (!png && !jpeg) throw Error(name, "neither a PNG nor a JPEG file");
  LoadedImage loaded;
  loaded.format = png ? "PNG" : "JPEG";
  loaded.flat = to_linear(png ? read_png(bytes, name) : read_jpeg(bytes, name));
  loaded.warnings.push_back(loaded.format + " is not HDR: light above white is lost");
  return loaded;
}

}  // namespace welkin
