#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace welkin {

/// Walks the headers of an OpenEXR file (OpenEXR File Layout, "Header") before the library sees them, because the
/// library believes the sizes that attributes give and takes memory for them. Returns a copy of the file's first bytes
/// up to the end of the headers, in which the attributes that decode_exr has no use for have an unknown type, so that
/// the library skips them by their checked size. Throws Error naming `name` when a size cannot be right.
std::vector<std::uint8_t> checked_exr_headers(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
