#include <welkin/realtime/gl/texture.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/error.h>

namespace welkin {
namespace {

struct GlFormat {
  GLenum internal, format, type;
};

GlFormat gl_format(TexelFormat format) {
  switch (format) {
    case TexelFormat::r8: return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case TexelFormat::rgba8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case TexelFormat::srgb8_alpha8: return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
    case TexelFormat::r16f: return {GL_R16F, GL_RED, GL_FLOAT};
    case TexelFormat::rg16f: return {GL_RG16F, GL_RG, GL_FLOAT};
    case TexelFormat::rgba16f: return {GL_RGBA16F, GL_RGBA, GL_FLOAT};
    case TexelFormat::r32f: return {GL_R32F, GL_RED, GL_FLOAT};
    case TexelFormat::rgba32f: return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case TexelFormat::depth: return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
  }
  return {};
}

void set_sampling(GLenum target, const TextureDesc& desc) {
  const GLint smallest = desc.levels > 1 ? (desc.linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST)
                                         : (desc.linear ? GL_LINEAR : GL_NEAREST);
  const GLint wrap = desc.repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, smallest);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, desc.linear ? GL_LINEAR : GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, wrap);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, desc.levels - 1);
}

// Largest finite half: what is above would become infinite.
constexpr float half_max = 65504;

std::vector<float> spread_channels(const float* from, std::size_t count, int channels, int wanted,
                                   bool half) {
  std::vector<float> texels(count * static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < wanted; ++c) {
      const float missing = c == 3 ? 1.0f : 0.0f;
      const float value = c < channels ? from[i * static_cast<std::size_t>(channels) + c] : missing;
      texels[i * static_cast<std::size_t>(wanted) + c] =
          half ? std::clamp(value, -half_max, half_max) : value;
    }
  }
  return texels;
}

int channels_of(TexelFormat format) {
  switch (format) {
    case TexelFormat::r8:
    case TexelFormat::r16f:
    case TexelFormat::r32f:
    case TexelFormat::depth: return 1;
    case TexelFormat::rg16f: return 2;
    default: return 4;
  }
}

bool is_half(TexelFormat format) {
  return format == TexelFormat::r16f || format == TexelFormat::rg16f || format == TexelFormat::rgba16f;
}

int full_chain(int size) {
  int levels = 1;
  while (size >> levels != 0) ++levels;
  return levels;
}

}  // namespace

GlTexture make_texture(const TextureDesc& desc) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexStorage2D(GL_TEXTURE_2D, desc.levels, gl_format(desc.format).internal, desc.width, desc.height);
  set_sampling(GL_TEXTURE_2D, desc);
  check_gl("making a texture");
  return texture;
}

GlTexture make_cube_texture(const TextureDesc& desc) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
  glTexStorage2D(GL_TEXTURE_CUBE_MAP, desc.levels, gl_format(desc.format).internal, desc.width, desc.width);
  set_sampling(GL_TEXTURE_CUBE_MAP, desc);
  check_gl("making a cube map");
  return texture;
}

GlTexture upload_image(const Image& image, TextureDesc desc, bool mipmaps) {
  if (image.empty()) throw Error("OpenGL: an empty image cannot be a texture");
  desc.width = image.width;
  desc.height = image.height;
  desc.levels = mipmaps ? full_chain(std::max(image.width, image.height)) : 1;
  GlTexture texture = make_texture(desc);
  const GlFormat format = gl_format(desc.format);
  const auto texels =
      spread_channels(image.pixels.data(), image.pixels.size() / static_cast<std::size_t>(image.channels),
                      image.channels, channels_of(desc.format), is_half(desc.format));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, format.format, format.type,
                  texels.data());
  if (mipmaps) glGenerateMipmap(GL_TEXTURE_2D);
  check_gl("uploading a texture");
  return texture;
}

GlTexture upload_levels(std::span<const Image> levels, TextureDesc desc) {
  if (levels.empty() || levels[0].empty()) throw Error("OpenGL: an empty image cannot be a texture");
  desc.width = levels[0].width;
  desc.height = levels[0].height;
  desc.levels = static_cast<int>(levels.size());
  GlTexture texture = make_texture(desc);
  const GlFormat format = gl_format(desc.format);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (int level = 0; level < desc.levels; ++level) {
    const Image& image = levels[static_cast<std::size_t>(level)];
    const auto texels =
        spread_channels(image.pixels.data(), static_cast<std::size_t>(image.width) * image.height,
                        image.channels, channels_of(desc.format), is_half(desc.format));
    glTexSubImage2D(GL_TEXTURE_2D, level, 0, 0, image.width, image.height, format.format, format.type,
                    texels.data());
  }
  check_gl("uploading a texture");
  return texture;
}

GlTexture upload_bytes(const std::vector<std::uint8_t>& rgba, TextureDesc desc, bool mipmaps) {
  desc.levels = mipmaps ? full_chain(std::max(desc.width, desc.height)) : 1;
  GlTexture texture = make_texture(desc);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, desc.width, desc.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  if (mipmaps) glGenerateMipmap(GL_TEXTURE_2D);
  check_gl("uploading a texture");
  return texture;
}

GlTexture upload_cube(const CubeMips& cube, TexelFormat format) {
  if (cube.empty()) throw Error("OpenGL: an empty cube cannot be a texture");
  TextureDesc desc;
  desc.width = cube.size();
  desc.format = format;
  desc.levels = static_cast<int>(cube.levels.size());
  GlTexture texture = make_cube_texture(desc);
  const GlFormat gl = gl_format(format);
  for (int level = 0; level < desc.levels; ++level) {
    const Cube& faces = cube.levels[static_cast<std::size_t>(level)];
    const std::size_t count = static_cast<std::size_t>(faces.size) * faces.size;
    for (int face = 0; face < 6; ++face) {
      const auto texels =
          spread_channels(faces.at(face, 0, 0), count, faces.channels, channels_of(format), is_half(format));
      glTexSubImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, 0, 0, faces.size,
                      faces.size, gl.format, gl.type, texels.data());
    }
  }
  check_gl("uploading a cube map");
  return texture;
}

GlTexture upload_volume(std::span<const Image> slices) {
  if (slices.empty() || slices[0].empty()) throw Error("OpenGL: no slices cannot be a texture");
  const int width = slices[0].width, height = slices[0].height;
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_3D, texture.name());
  glTexStorage3D(GL_TEXTURE_3D, 1, GL_RGBA16F, width, height, static_cast<GLsizei>(slices.size()));
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (std::size_t z = 0; z < slices.size(); ++z) {
    const auto texels =
        spread_channels(slices[z].pixels.data(), static_cast<std::size_t>(width) * height, 3, 4, true);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, static_cast<GLint>(z), width, height, 1, GL_RGBA, GL_FLOAT,
                    texels.data());
  }
  check_gl("uploading a 3-D texture");
  return texture;
}

Cube read_cube(const GlTexture& texture, int size, int level) {
  const GlFramebuffer framebuffer = GlFramebuffer::make();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  Cube cube(size);
  std::vector<float> rgba(std::size_t{4} * size * size);
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), texture.name(), level);
    glReadPixels(0, 0, size, size, GL_RGBA, GL_FLOAT, rgba.data());
    for (std::size_t i = 0; i < rgba.size() / 4; ++i)
      std::copy_n(&rgba[4 * i], 3, cube.at(face, 0, 0) + 3 * i);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  check_gl("reading a cube map");
  return cube;
}

void RenderTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, width, height);
}

RenderTarget make_render_target(int width, int height, const TexelFormat* colors, int count, bool depth) {
  RenderTarget target;
  target.width = width;
  target.height = height;
  target.framebuffer = GlFramebuffer::make();
  TextureDesc desc;
  desc.width = width;
  desc.height = height;
  GLenum buffers[4] = {};
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
  for (int i = 0; i < count; ++i) {
    desc.format = colors[i];
    desc.linear = colors[i] != TexelFormat::r32f && colors[i] != TexelFormat::rgba32f;
    target.colors[i] = make_texture(desc);
    buffers[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    glFramebufferTexture2D(GL_FRAMEBUFFER, buffers[i], GL_TEXTURE_2D, target.colors[i].name(), 0);
  }
  glDrawBuffers(count, buffers);
  if (depth) {
    desc.format = TexelFormat::depth;
    desc.linear = false;
    target.depth = make_texture(desc);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, target.depth.name(), 0);
  }
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) throw Error("OpenGL: the driver cannot draw to float textures (EXT_color_buffer_float)");
  check_gl("making a render target");
  return target;
}

Image read_pixels(const RenderTarget& target, int index) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.name());
  glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index));
  Image bottom_up(target.width, target.height, 4);
  glReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_FLOAT, bottom_up.pixels.data());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  check_gl("reading pixels");
  Image image(target.width, target.height, 4);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(bottom_up.at(0, image.height - 1 - y), std::size_t{4} * image.width, image.at(0, y));
  return image;
}

ByteImage read_bytes(const RenderTarget& target) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.name());
  std::vector<std::uint8_t> rgba(std::size_t{4} * target.width * target.height);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  check_gl("reading bytes");
  ByteImage image(target.width, target.height, 3);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* from =
        rgba.data() + std::size_t{4} * target.width * static_cast<std::size_t>(image.height - 1 - y);
    for (int x = 0; x < image.width; ++x) std::copy_n(from + std::size_t{4} * x, 3, image.at(x, y));
  }
  return image;
}

TexelFormat finest_filtered_format() {
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const auto* name = reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (name != nullptr && std::string_view(name).ends_with("OES_texture_float_linear"))
      return TexelFormat::rgba32f;
  }
  return TexelFormat::rgba16f;
}

void bind_texture(int unit, GLenum target, const GlTexture& texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, texture.name());
}

}  // namespace welkin
