#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include <welkin/image/codecs/block_quality.h>
#include <welkin/image/codecs/encoded_texture.h>
#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>
#include <welkin/image/packed_formats.h>
#include <welkin/image/range_fit.h>

// DirectDraw surface files (Microsoft, DDS Programming Guide) with the DX10 header: cube maps with mip levels and flat
// images in float formats and BC6H. Direct3D's faces have the same order and the same texels as OpenGL's and KTX's.
//
// DDS has no place for text. So the scale that values were divided by to fit the format, and what the values mean,
// must be recorded elsewhere by whoever writes the file (EncodedTexture::stored_scale says which it is).

namespace welkin {

struct DdsOptions {
  PixelFormat format = PixelFormat::rgba16f;
  RangePolicy range = RangePolicy::scale;
  /// A power of two that the values are divided by; 0 chooses by `range`.
  double stored_scale = 0;
  BlockQuality quality = BlockQuality::normal;  ///< for BC6H
  bool shared_edges =
      false;  ///< cubes whose faces hold equal texels along edges: keep them so, see SurfaceEncoder
};

/// Encodes all levels of a cube (1 to 4 channels, see encode_pixels; alpha = 1): each face with its own levels after
/// it. true value = stored value * EncodedTexture::stored_scale, which is NOT in the file. Throws Error for an empty
/// cube, levels that do not halve, a scale that is not a power of two, and ASTC, for which DDS has no number.
EncodedTexture encode_dds(const CubeMips& cube, const DdsOptions& options = {});

/// The same for a flat image with one level; row 0 is the top.
EncodedTexture encode_dds(const Image& image, const DdsOptions& options = {});

/// Decodes cube maps with any number of levels and flat images (their largest level): DX10 R32G32B32A32_FLOAT,
/// R32G32B32_FLOAT, R16G16B16A16_FLOAT, R32G32_FLOAT, R16G16_FLOAT, R9G9B9E5_SHAREDEXP, R11G11B10_FLOAT, BC6H_UF16,
/// BC6H_SF16, and the old FourCC numbers 112
/// (G16R16F), 113 (A16B16G16R16F), 115 (G32R32F), 116 (A32B32G32R32F). Pixels are as stored: multiply by the scale that
/// was recorded elsewhere. Two channels get a zero third one; alpha is dropped. Throws Error naming `name` for anything
/// damaged, truncated or of another kind; cubes must have all six faces.
LoadedImage decode_dds(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
