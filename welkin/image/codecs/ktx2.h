#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/image/codecs/block_quality.h>
#include <welkin/image/codecs/encoded_texture.h>
#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>
#include <welkin/image/packed_formats.h>
#include <welkin/image/range_fit.h>

// KTX 2.0 files (Khronos, KTX File Format Specification 2.0, revision 4): cube maps with mip levels and flat
// images in float formats and HDR blocks, with Zstandard supercompression by choice, and text keys that say what the
// numbers mean.

namespace welkin {

/// The key under which `welkin ibl` says what was done to the edges of a cube's faces ("warp" or "average",
/// welkin/sphere/cube_edge_fixup.h). The reader warns of "warp": texels lie elsewhere than in other cubes.
inline constexpr std::string_view ktx2_edge_fixup_key = "WelkinEdgeFixup";

struct Ktx2Options {
  PixelFormat format = PixelFormat::rgba16f;
  RangePolicy range = RangePolicy::scale;
  /// A power of two that the values are divided by, for files that must share one scale; 0 chooses by
  /// `range`.
  double stored_scale = 0;
  /// 0 stores plain bytes, 1 (fast) to 22 (small) compresses each level with Zstandard.
  int zstd_level = 0;
  /// Further keys, e.g. {"WelkinQuantity", "prefiltered radiance"}; UTF-8 without zero bytes. Keys that begin
  /// with "KTX" or "ktx" are reserved by the specification, WelkinStoredScale is written by the encoder: both
  /// are refused.
  std::map<std::string, std::string> keys;
  BlockQuality quality = BlockQuality::normal;  ///< for BC6H and ASTC
  bool shared_edges =
      false;  ///< cubes whose faces hold equal texels along edges: keep them so, see SurfaceEncoder
};

/// Encodes all levels of a cube (1, 2, 3 or 4 channels, see encode_pixels; alpha = 1), linear Rec.709. The values are
/// divided by EncodedTexture::stored_scale; unless that is 1 the key WelkinStoredScale names it (decimal text):
/// true value = stored value * WelkinStoredScale, and a file without the key has 1. KTXorientation is "rd". Keys that
/// are not Khronos' own are legal, but validators remark on each of them: a file without `keys` and without a scale
/// validates without a word. Throws Error for an empty cube, levels that do not halve, and bad options.
EncodedTexture encode_ktx2(const CubeMips& cube, const Ktx2Options& options = {});

/// The same for a flat image with one level; KTXorientation "rd" (row 0 is the top).
EncodedTexture encode_ktx2(const Image& image, const Ktx2Options& options = {});

/// Numbers that are no colours (tables), bit for bit: a flat texture with one level in R32, R32G32, R32G32B32 or
/// R32G32B32A32 SFLOAT, by the image's 1 to 4 channels; KTXorientation "rd". decode_ktx2 gives the first three back.
/// Throws Error for an empty image and bad keys.
std::vector<std::uint8_t> encode_ktx2_table(const Image& table,
                                            const std::map<std::string, std::string>& keys = {});

/// Decodes cube maps with any number of levels and flat images (their largest level) in R16G16, R16G16B16,
/// R16G16B16A16, R32, R32G32, R32G32B32, R32G32B32A32 SFLOAT, E5B9G9R9, B10G11R11, BC6H (both) and ASTC HDR 4x4 and
/// 6x6, plain or with Zstandard. The pixels are true values: WelkinStoredScale is multiplied back in, and
/// LoadedImage::stored_scale is 1. A flat image that is stored upside down or mirrored (KTXorientation) is turned to
/// rows from the top. One channel is repeated as gray, two get a zero third one; alpha is dropped. Throws Error naming
/// `name` for anything damaged, truncated or of another kind.
LoadedImage decode_ktx2(std::span<const std::uint8_t> bytes, std::string_view name);

/// The key/value texts of a file, without the terminating zero; values that are not text come as they are.
/// Throws like decode_ktx2, but looks only at the header and the keys.
std::map<std::string, std::string> read_ktx2_keys(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
