#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <exception>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>

namespace welkin {
namespace {

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : OStream("memory") {}
  void write(const char data[], int count) override {
    const std::size_t end = position_ + static_cast<std::size_t>(count);
    if (bytes.size() < end) bytes.resize(end);
    std::memcpy(bytes.data() + position_, data, static_cast<std::size_t>(count));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> bytes;

 private:
  std::size_t position_ = 0;
};

std::vector<half> to_halves(const std::vector<float>& values, float factor) {
  std::vector<half> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [factor](float value) {
    const float scaled = value * factor;
    return half(std::isnan(scaled) ? scaled : std::clamp(scaled, -float{HALF_MAX}, float{HALF_MAX}));
  });
  return result;
}

std::vector<float> scaled_by(const std::vector<float>& values, float factor) {
  std::vector<float> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [factor](float value) { return value * factor; });
  return result;
}

const char* channel_name(int channels, int channel) {
  constexpr const char* names[] = {"R", "G", "B", "A"};
  return channels == 1 ? "Y" : names[channel];
}

void write_pixels(MemoryOutput& stream, const Imf::Header& header, const Image& image, Imf::PixelType type,
                  const void* pixels, std::size_t value_size) {
  Imf::FrameBuffer buffer;
  for (int c = 0; c < image.channels; ++c) {
    // A frame buffer is for reading and writing alike, so it has no const; writing leaves the pixels alone.
    char* base = static_cast<char*>(const_cast<void*>(pixels)) + static_cast<std::size_t>(c) * value_size;
    const std::size_t pixel_size = value_size * image.channels;
    buffer.insert(channel_name(image.channels, c),
                  Imf::Slice(type, base, pixel_size, pixel_size * image.width));
  }
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(buffer);
  file.writePixels(image.height);
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Image& image, const ExrOptions& options) {
  assert(image.width > 0 && image.height > 0 &&
         (image.channels == 1 || image.channels == 3 || image.channels == 4));
  const bool halves = options.pixel_type == ExrPixelType::half_float;
  const Imf::PixelType type = halves ? Imf::HALF : Imf::FLOAT;
  try {
    Imf::setGlobalThreadCount(0);
    Imf::Header header(image.width, image.height, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y,
                       Imf::ZIP_COMPRESSION);
    for (int c = 0; c < image.channels; ++c) {
      header.channels().insert(channel_name(image.channels, c), Imf::Channel(type));
    }
    if (options.stored_scale != 1)
      header.insert("welkinStoredScale", Imf::DoubleAttribute(options.stored_scale));
    const auto factor = static_cast<float>(1 / options.stored_scale);
    MemoryOutput stream;
    if (halves) {
      write_pixels(stream, header, image, type, to_halves(image.pixels, factor).data(), sizeof(half));
    } else {
      write_pixels(stream, header, image, type, scaled_by(image.pixels, factor).data(), sizeof(float));
    }
    return std::move(stream.bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(std::string("cannot encode as OpenEXR: ") + error.what());
  }
}

}  // namespace welkin
