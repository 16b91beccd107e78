#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/codecs/ldr_samples.h>

// Stands for the files of libpng (png_read.cpp, png_write.cpp) and TurboJPEG (jpeg_read.cpp, jpeg_write.cpp) where there are
// no such libraries: the web build, where the browser decodes pictures.

namespace welkin {
namespace {

[[noreturn]] void refuse(std::string_view name) {
  throw Error(name, "is a PNG or JPEG picture, which this build cannot read");
}

}  // namespace

LdrSamples read_png(std::span<const std::uint8_t>, std::string_view name, bool) { refuse(name); }
LdrSamples read_jpeg(std::span<const std::uint8_t>, std::string_view name) { refuse(name); }
std::vector<std::uint8_t> encode_png(const ByteImage&) { throw Error("PNG cannot be written by this build"); }

std::vector<std::uint8_t> encode_jpeg(const ByteImage&, int) {
  throw Error("JPEG cannot be written by this build");
}

}  // namespace welkin
