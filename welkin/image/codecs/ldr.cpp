#include <welkin/image/codecs/ldr.h>

#include <algorithm>
#include <array>
#include <cassert>
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

// Colour through the table of the sRGB curve or, as alpha always, divided by the largest value.
template <class Read>
void fill(Image& image, float largest, const std::vector<float>* curve, Read&& read) {
  const int colors = curve == nullptr ? 0 : 3;
  for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels)) {
    for (int c = 0; c < image.channels; ++c) {
      const std::size_t value = read(i + c);
      image.pixels[i + c] = c < colors ? (*curve)[value] : static_cast<float>(value) / largest;
    }
  }
}

Image to_linear(const LdrSamples& samples, LdrEncoding encoding) {
  Image image(samples.width, samples.height, samples.channels);
  const std::uint8_t* bytes = samples.bytes.data();
  const bool srgb = encoding == LdrEncoding::srgb;
  if (samples.bits == 16) {
    static const std::vector<float> table = linear_values(65536);
    fill(image, 65535, srgb ? &table : nullptr,
         [bytes](std::size_t i) { return static_cast<std::size_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]); });
  } else {
    static const std::vector<float> table = linear_values(256);
    fill(image, 255, srgb ? &table : nullptr, [bytes](std::size_t i) { return std::size_t{bytes[i]}; });
  }
  return image;
}

bool is_png(std::span<const std::uint8_t> bytes, std::string_view name) {
  const bool png = starts_with(bytes, png_magic);
  if (!png && !starts_with(bytes, jpeg_magic)) throw Error(name, "neither a PNG nor a JPEG file");
  return png;
}

}  // namespace

LoadedImage decode_ldr(std::span<const std::uint8_t> bytes, std::string_view name) {
  const bool png = is_png(bytes, name);
  LoadedImage loaded;
  loaded.format = png ? "PNG" : "JPEG";
  loaded.flat = to_linear(png ? read_png(bytes, name) : read_jpeg(bytes, name), LdrEncoding::srgb);
  loaded.warnings.push_back(loaded.format + " is not HDR: light above white is lost");
  return loaded;
}

Image decode_ldr_texture(std::span<const std::uint8_t> bytes, std::string_view name, LdrEncoding encoding) {
  return to_linear(is_png(bytes, name) ? read_png(bytes, name, true) : read_jpeg(bytes, name), encoding);
}

Image linear_texture(const ByteImage& picture, LdrEncoding encoding) {
  assert(picture.channels == 3 || picture.channels == 4);
  return to_linear({picture.width, picture.height, 8, picture.channels, picture.pixels}, encoding);
}

}  // namespace welkin
