#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/block_quality.h>
#include <welkin/image/packed_formats.h>

namespace welkin {

/// How the texels of .ktx2 and .dds files are stored, as options of a command.
struct TextureInput {
  std::string format = "rgba16f", quality = "normal";

  /// Throws Error for a name that the option's check would not let through.
  PixelFormat pixel_format() const {
    if (const auto parsed = colour_format_from_name(format)) return *parsed;
    throw Error("unknown format '" + format + "'");
  }
  BlockQuality block_quality() const {
    return quality == "fast"   ? BlockQuality::fast
           : quality == "high" ? BlockQuality::high
                               : BlockQuality::normal;
  }
};

/// Environments are >= 0: signed BC6H is offered only where `with_signed` says so.
inline void add_texture_options(CLI::App& sub, TextureInput& in, const std::string& what, bool with_signed) {
  std::vector<std::string> names{"rgba16f", "rgba32f", "rgb9e5", "r11g11b10f", "bc6h", "astc", "astc6x6"};
  if (with_signed) names.push_back("bc6h_signed");
  sub.add_option("--format", in.format, what)->check(CLI::IsMember(names))->capture_default_str();
  sub.add_option("--quality", in.quality, "How long bc6h and astc may search: fast, normal or high")
      ->check(CLI::IsMember({"fast", "normal", "high"}))
      ->capture_default_str();
}

/// Throws CLI::ValidationError where a container ("ktx2", "dds", "exr") cannot hold the format.
inline void check_container(const TextureInput& in, const std::string& container) {
  const PixelLayout layout = pixel_layout(in.pixel_format());
  const bool plain =
      layout.component == PixelLayout::Component::half || layout.component == PixelLayout::Component::float32;
  if (container == "exr" && !plain)
    throw CLI::ValidationError("--format",
                               "OpenEXR has no " + in.format + "; choose rgba16f or rgba32f, or write KTX2");
  if (container == "dds" && layout.component == PixelLayout::Component::astc_hdr)
    throw CLI::ValidationError("--format", "DDS has no " + in.format + "; choose bc6h, or ktx2");
}

}  // namespace welkin
