#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <span>

#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>
#include <welkin/realtime/gl/objects.h>

// Textures and what is drawn into them. Row 0 of what is uploaded is the texture's t = 0. Pictures drawn by the camera
// have their bottom row first, as OpenGL has it; read_pixels turns them so that row 0 is the top.

namespace welkin {

/// How texels are stored. Everything but `depth` can be drawn to where the driver has EXT_color_buffer_float (r8, rgba8 and srgb8 always).
enum class TexelFormat { r8, rgba8, srgb8_alpha8, r16f, rg16f, rgba16f, r32f, rgba32f, depth };

struct TextureDesc {
  int width = 0, height = 0;
  TexelFormat format = TexelFormat::rgba16f;
  int levels = 1;  ///< 1 to log2(max(width, height)) + 1
  bool linear =
      true;  ///< else nearest; 32-bit floats need OES_texture_float_linear for linear, which not all drivers have
  bool repeat = false;  ///< else clamped to the edge
};

/// A 2-D texture, not initialised. Throws Error where the driver refuses it.
GlTexture make_texture(const TextureDesc& desc);
/// A cube map of `desc.width`, `desc.height` ignored.
GlTexture make_cube_texture(const TextureDesc& desc);

/// An image of 1 to 4 channels as r, rg or rgba (missing colours 0, alpha 1) with its mip chain by the driver if wanted.
/// Format: rgba16f; r32f and rgba32f keep floats as they are.
GlTexture upload_image(const Image& image, TextureDesc desc, bool mipmaps);
/// Mip levels that the caller made: levels[k] has max(1, size >> k) texels along an edge. Channels as upload_image; desc gives the format and
/// how it is sampled.
GlTexture upload_levels(std::span<const Image> levels, TextureDesc desc);
/// width * height * 4 bytes as rgba8 or srgb8_alpha8, with mips (averaged in linear light) if wanted.
GlTexture upload_bytes(const std::vector<std::uint8_t>& rgba, TextureDesc desc, bool mipmaps);
/// All levels of a cube of 3 channels. Throws Error for an empty one.
GlTexture upload_cube(const CubeMips& cube, TexelFormat format = TexelFormat::rgba16f);

/// Images of 3 channels and one size as the slices of a 3-D texture, rgba16f, linear in all three directions, clamped to
/// the edge.
GlTexture upload_volume(std::span<const Image> slices);

/// One level of a cube that is in OpenGL, 3 channels: for tests and for comparing with the truth.
Cube read_cube(const GlTexture& texture, int size, int level);

/// What a pass draws into: up to four textures of one size and a depth buffer.
struct RenderTarget {
  int width = 0, height = 0;
  GlFramebuffer framebuffer;
  GlTexture colors[4];  ///< as many as were asked for
  GlTexture depth;      ///< a depth texture (sampled by nearest); none if not asked for

  void bind() const;  ///< as draw framebuffer, viewport = all of it
};

RenderTarget make_render_target(int width, int height, const TexelFormat* colors, int count, bool depth);

/// The colour attachment `index` as floats of 4 channels, row 0 the top.
Image read_pixels(const RenderTarget& target, int index = 0);

/// The only colour attachment, of format rgba8, as bytes of 3 channels, row 0 the top.
ByteImage read_bytes(const RenderTarget& target);

/// rgba32f where the driver filters it linearly (OES_texture_float_linear), else rgba16f.
TexelFormat finest_filtered_format();

/// Binds a texture to a unit.
void bind_texture(int unit, GLenum target, const GlTexture& texture);

}  // namespace welkin
