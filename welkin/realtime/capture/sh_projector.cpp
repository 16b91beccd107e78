#include <welkin/realtime/capture/sh_projector.h>

#include <algorithm>
#include <string>
#include <utility>

#include <welkin/error.h>
#include <welkin/realtime/gpu_scene.h>
#include <welkin/sh/lookup.h>

namespace welkin {
namespace {

constexpr int map_unit = first_technique_unit, table_unit = map_unit + 1, rows_unit = map_unit + 1;

Image table_image(const ShProjectionLookup& lookup, int tiles) {
  const int w = lookup.shape.width, h = lookup.shape.height;
  Image image(tiles * w, tiles * h, 1);
  for (int i = 0; i < tiles * tiles; ++i)
    for (int y = 0; y < h; ++y)
      std::copy_n(&lookup.values[(static_cast<std::size_t>(i) * h + y) * w], w,
                  image.at(i % tiles * w, i / tiles * h + y));
  return image;
}

// Four coefficients a texel, 0 where there are none; tiles below each other.
Image packed_image(const ShProjectionLookup& lookup, int count, int groups) {
  const int w = lookup.shape.width, h = lookup.shape.height;
  const std::size_t texels = static_cast<std::size_t>(w) * h;
  Image image(w, groups * h, 4);
  for (int i = 0; i < count; ++i)
    for (std::size_t k = 0; k < texels; ++k)
      image.pixels[4 * (i / 4 * texels + k) + i % 4] = lookup.values[i * texels + k];
  return image;
}

void check_texture_size(const Image& image) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (std::max(image.width, image.height) > most)
    throw Error("OpenGL: the look-up table of the projection has " +
                std::to_string(std::max(image.width, image.height)) +
                " texels along a side, and this driver's textures at most " + std::to_string(most) +
                ": use a lower degree or a smaller capture");
}

GlTexture upload_table(const Image& image, TexelFormat format) {
  check_texture_size(image);
  TextureDesc desc;
  desc.format = format;
  desc.linear = false;
  return upload_image(image, desc, false);
}

}  // namespace

ShProjector::ShProjector(MapShape shape, int degree, ShProjectionMethod method)
    : shape_(shape),
      size_(shape.mapping == Mapping::cube ? shape.width : shape.height),
      degree_(degree),
      count_((degree + 1) * (degree + 1)),
      groups_((count_ + 3) / 4),
      method_(method) {
  if (method == ShProjectionMethod::compute && !has_compute())
    throw Error("OpenGL: the driver has no compute shaders (ES 3.1): use projection staged or tiled");
  make_tables();
  const char* define = shape.mapping == Mapping::cube ? "#define INPUT_CUBE\n" : "";
  constexpr TexelFormat sums[4] = {TexelFormat::rgba32f, TexelFormat::rgba32f, TexelFormat::rgba32f,
                                   TexelFormat::rgba32f};
  coefficients_ = make_render_target(count_, 1, sums, 1, false);
  if (method == ShProjectionMethod::tiled) {
    first_ = Program("fullscreen.vert", "sh_tiled.frag", define);
  } else if (method == ShProjectionMethod::staged) {
    rows_ = make_render_target(groups_, shape.height, sums, 4, false);
    first_ = Program("fullscreen.vert", "sh_rows.frag", define);
    second_ = Program("fullscreen.vert", "sh_sum_rows.frag");
  } else {
#ifndef __EMSCRIPTEN__
    first_ = Program::compute("sh_rows.comp", define);
    second_ = Program::compute("sh_sum_rows.comp");
#endif
  }
  check_gl("making a projector");
}

void ShProjector::make_tables() {
  const ShProjectionLookup lookup = make_sh_projection_lookup(shape_, degree_, TexelRule::integrated);
  if (method_ == ShProjectionMethod::tiled) {
    table_ = upload_table(table_image(lookup, degree_ + 1), TexelFormat::r32f);
    return;
  }
  const Image packed = packed_image(lookup, count_, groups_);
  if (method_ == ShProjectionMethod::staged) {
    table_ = upload_table(packed, TexelFormat::rgba32f);
    return;
  }
#ifndef __EMSCRIPTEN__
  table_buffer_ = GlBuffer::make();
  rows_buffer_ = GlBuffer::make();
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, table_buffer_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(4 * packed.pixels.size()),
               packed.pixels.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, rows_buffer_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(64) * groups_ * shape_.height, nullptr,
               GL_DYNAMIC_COPY);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
#endif
}

void ShProjector::set_map(const Program& program, const GlTexture& radiance) const {
  program.use();
  program.set_texture("radiance_map", map_unit,
                      shape_.mapping == Mapping::cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D, radiance);
  program.set("size", size_);
  program.set("width", shape_.width);
  program.set("height", shape_.height);
  program.set("tiles", degree_ + 1);
}

void ShProjector::project(const GlTexture& radiance, const Fullscreen& fullscreen) const {
  if (method_ == ShProjectionMethod::compute) return project_compute(radiance);
  glDisable(GL_DEPTH_TEST);
  (method_ == ShProjectionMethod::tiled ? coefficients_ : rows_).bind();
  set_map(first_, radiance);
  first_.set_texture("table", table_unit, GL_TEXTURE_2D, table_);
  fullscreen.draw();
  if (method_ == ShProjectionMethod::staged) {
    coefficients_.bind();
    second_.use();
    constexpr const char* names[4] = {"rows0", "rows1", "rows2", "rows3"};
    for (int i = 0; i < 4; ++i) second_.set_texture(names[i], rows_unit + i, GL_TEXTURE_2D, rows_.colors[i]);
    second_.set("height", shape_.height);
    fullscreen.draw();
  }
}

void ShProjector::project_compute([[maybe_unused]] const GlTexture& radiance) const {
#ifndef __EMSCRIPTEN__
  set_map(first_, radiance);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, table_buffer_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, rows_buffer_.name());
  glDispatchCompute(static_cast<GLuint>(shape_.height + 31) / 32, static_cast<GLuint>(groups_), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  second_.use();
  second_.set("height", shape_.height);
  second_.set("count", count_);
  glBindImageTexture(0, coefficients().name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glDispatchCompute(static_cast<GLuint>(count_ + 15) / 16, 1, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
#endif
}

ShCoefficients ShProjector::read() const {
  const Image pixels = read_pixels(coefficients_);
  ShCoefficients result(degree_, 3);
  for (int i = 0; i < count_; ++i)
    for (int c = 0; c < 3; ++c)
      result.values[3 * static_cast<std::size_t>(i) + c] = static_cast<double>(pixels.at(i, 0)[c]);
  return result;
}

}  // namespace welkin
