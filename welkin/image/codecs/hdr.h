#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/image/image.h>

// Radiance pictures (.hdr, .pic): shared-exponent RGBE (Ward 1991, "Real Pixels", Graphics Gems II) or XYZE.
//
// A pixel (r, g, b, e) means (r, g, b) * 2^(e - 136), and black where e = 0. Radiance's own tools decode the
// middle of the interval, (r + 0.5) * 2^(e - 136), because they truncate when they encode; nearly everyone
// else, and so every HDR map in circulation, takes the mantissa as it is and rounds to nearest when encoding.
// So does welkin, both ways.

namespace welkin {

/// Decodes a picture in any of its forms: flat, old run lengths, new run lengths per scan line or a mix of
/// them, all eight orientations, RGBE and XYZE. EXPOSURE and COLORCORR lines (they accumulate by
/// multiplication) are divided out, so the result is what was there before any tool scaled it. XYZE is
/// converted to linear Rec.709 with a D65 white (Y = 1 gives 1); negative components can come out for colours
/// outside Rec.709. PRIMARIES lines are not applied. Returns 3 channels, row 0 at the top. Throws Error
/// naming `name` for anything that is damaged or truncated.
Image decode_hdr(std::span<const std::uint8_t> bytes, std::string_view name);

/// Encodes as 32-bit_rle_rgbe, -Y +X, new run lengths where the format has them (widths 8 to 32767), else
/// flat. `image` has 1 (gray) or 3 channels. Mantissas are rounded to nearest: the error of a component is at
/// most 1/256 of the pixel's largest one. Values above 255 * 2^119 (1.69e38) saturate; negative values and
/// NaN become 0, and so does a pixel whose largest component is below 2^-128.
std::vector<std::uint8_t> encode_hdr(const Image& image);

}  // namespace welkin
