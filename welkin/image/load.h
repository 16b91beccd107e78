#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>

namespace welkin {

/// Reads an image file: Radiance HDR, OpenEXR, PNG, JPEG, KTX2 or DDS, told apart by its first bytes, never
/// by its name. Values are as the file has them: NaN, infinity and negative ones are left for repair_faults.
/// Throws Error naming the file when it cannot be read.
LoadedImage load_image(const std::filesystem::path& path);

/// The same from memory; `name` is for messages.
LoadedImage decode_image(std::span<const std::uint8_t> bytes, std::string_view name);

/// Writes a flat image of 1 or 3 channels in the format that the extension names: .hdr (or .pic), .exr (half
/// floats; for more options use encode_exr), .png (exposed automatically and tone-mapped: for looking at, see
/// tonemap.h). The file appears whole or not at all. Throws Error naming the file for another extension or
/// when writing fails.
void save_image(const std::filesystem::path& path, const Image& image);

}  // namespace welkin
