#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/pathtrace/picture.h>

namespace welkin {

/// A picture that is not finished, as bytes: a header, the arrays of the state as they are in memory (little-endian), a
/// checksum. For the same program to go on with, not for archives.
std::vector<std::uint8_t> encode_checkpoint(const PictureState& state, std::uint64_t fingerprint);

/// Reads it back. Throws Error naming `name` for anything that is not whole, or of another size or fingerprint
/// (picture_fingerprint) than the picture that is asked for.
PictureState decode_checkpoint(std::span<const std::uint8_t> bytes, std::string_view name, PictureSize size,
                               std::uint64_t fingerprint);

}  // namespace welkin
