#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>

namespace welkin {

/// Throws Error naming the file unless encode_flat knows its extension.
void check_flat_name(const std::string& path);

/// A flat image in the format that the extension of `path` names: .hdr, .exr or .png (tone-mapped, for looking at).
/// OpenEXR gets half floats, and single ones where `single` asks for them or a value is beyond what half floats hold. Says on standard error
/// what .hdr cannot hold (negative values).
std::vector<std::uint8_t> encode_flat(const std::string& path, const Image& image, bool single = false);

/// load_image, or make_sky where the name is a sky ("sky:day,elevation=20").
LoadedImage load_file_or_sky(const std::string& name);

/// Throws Error, before any work, where `path` is the file `input` or lies in no folder that exists. "" is no file.
void check_output(const std::string& path, const std::string& input);

/// The extension in lower case, with its dot.
std::string extension_of(const std::string& path);

}  // namespace welkin
