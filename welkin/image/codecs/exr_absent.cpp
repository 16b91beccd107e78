#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/exr_layers.h>

// Stands for exr.cpp, exr_write.cpp and exr_layers.cpp where there is no OpenEXR library (the web build).

namespace welkin {
namespace {

[[noreturn]] void refuse_to_read(std::string_view name) {
  throw Error(name, "is an OpenEXR file, which this build cannot read");
}

[[noreturn]] void refuse_to_write() { throw Error("OpenEXR files cannot be written by this build"); }

}  // namespace

LoadedImage decode_exr(std::span<const std::uint8_t>, std::string_view name) { refuse_to_read(name); }
std::vector<std::uint8_t> encode_exr(const Image&, const ExrOptions&) { refuse_to_write(); }
ExrLayers decode_exr_layers(std::span<const std::uint8_t>, std::string_view name) { refuse_to_read(name); }
std::vector<std::uint8_t> encode_exr_layers(const ExrLayers&) { refuse_to_write(); }
const ExrLayer* find_layer(const ExrLayers&, std::string_view, std::span<const std::string_view>) {
  return nullptr;
}

}  // namespace welkin
