#include <welkin/realtime/capture/lobe_cube.h>

#include <welkin/error.h>
#include <welkin/realtime/gpu_scene.h>
#include <welkin/sh/lookup.h>

namespace welkin {
namespace {

constexpr int table_unit = first_technique_unit, coefficient_unit = table_unit + 1;

Image table_image(int size, std::span<const double> factors) {
  const int tiles = static_cast<int>(factors.size());
  const ShSynthesisLookup lookup = make_sh_synthesis_lookup(map_shape(Mapping::cube, size), tiles - 1);
  Image image(tiles * size, tiles * 6 * size, 1);
  std::size_t from = 0;
  for (int i = 0; i < tiles * tiles; ++i) {
    int degree = 0;
    while ((degree + 1) * (degree + 1) <= i) ++degree;
    for (int y = 0; y < 6 * size; ++y)
      for (int x = 0; x < size; ++x)
        *image.at(i % tiles * size + x, i / tiles * 6 * size + y) = static_cast<float>(
            factors[static_cast<std::size_t>(degree)] * static_cast<double>(lookup.values[from++]));
  }
  return image;
}

}  // namespace

LobeCube::LobeCube(int size, std::span<const double> factors)
    : size_(size), tiles_(static_cast<int>(factors.size())) {
  TextureDesc desc;
  desc.width = size;
  cube_ = make_cube_texture(desc);
  desc.format = TexelFormat::r32f;
  desc.linear = false;
  table_ = upload_image(table_image(size, factors), desc, false);
  framebuffer_ = GlFramebuffer::make();
  program_ = Program("fullscreen.vert", "sh_evaluate.frag");
}

void LobeCube::draw(const GlTexture& coefficients, const Fullscreen& fullscreen) const {
  glDisable(GL_DEPTH_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, size_, size_);
  program_.use();
  program_.set_texture("table", table_unit, GL_TEXTURE_2D, table_);
  program_.set_texture("coefficients", coefficient_unit, GL_TEXTURE_2D, coefficients);
  program_.set("size", size_);
  program_.set("tiles", tiles_);
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), cube_.name(), 0);
    program_.set("face", face);
    fullscreen.draw();
  }
}

}  // namespace welkin
