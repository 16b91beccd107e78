#include <welkin/realtime/techniques/bump_techniques.h>

namespace welkin {
namespace {

GLint gl_wrap(TextureWrap wrap) {
  return wrap == TextureWrap::repeat  ? GL_REPEAT
         : wrap == TextureWrap::clamp ? GL_CLAMP_TO_EDGE
                                      : GL_MIRRORED_REPEAT;
}

GlTexture upload(const std::vector<Image>& levels, const Texture& texture) {
  TextureDesc desc;
  desc.format = finest_filtered_format();
  GlTexture uploaded = upload_levels(levels, desc);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
  return uploaded;
}

}  // namespace

std::size_t GpuBumpMaps::find_or_make(const Texture& texture, int index, float normal_scale) {
  for (std::size_t i = 0; i < maps_.size(); ++i)
    if (maps_[i].texture == index && maps_[i].normal_scale == normal_scale) return i;
  const BumpMaps made = make_bump_maps(texture, normal_scale);
  Maps maps;
  maps.slopes = upload(made.slopes, texture);
  maps.shapes = upload(made.shapes, texture);
  maps.normals = upload(made.normals, texture);
  maps.size = {static_cast<float>(texture.image.width), static_cast<float>(texture.image.height)};
  maps.texture = index;
  maps.normal_scale = normal_scale;
  maps_.push_back(std::move(maps));
  return maps_.size() - 1;
}

void GpuBumpMaps::update(const Frame& frame) {
  if (scene_serial_ == frame.scene.serial) return;
  maps_.clear();
  of_material_.clear();
  for (const Material& material : frame.scene.materials) {
    const int texture = material.normal_texture.texture;
    of_material_.push_back(
        texture < 0 ? -1
                    : static_cast<int>(find_or_make(frame.source.textures[static_cast<std::size_t>(texture)],
                                                    texture, material.normal_scale)));
  }
  if (!none_) none_ = upload_image(Image(1, 1, 4), {}, false);
  scene_serial_ = frame.scene.serial;
}

void GpuBumpMaps::material_set(const Program& program, int material) {
  const int index = of_material_[static_cast<std::size_t>(material)];
  const Maps* maps = index < 0 ? nullptr : &maps_[static_cast<std::size_t>(index)];
  program.set("bump_present", maps != nullptr ? 1 : 0);
  program.set("bump_size", maps != nullptr ? maps->size : Vec2f{1, 1});
  const int unit = first_technique_unit;
  program.set_texture("bump_slopes", unit, GL_TEXTURE_2D, maps != nullptr ? maps->slopes : none_);
  program.set_texture("bump_shapes", unit + 1, GL_TEXTURE_2D, maps != nullptr ? maps->shapes : none_);
  program.set_texture("bump_normals", unit + 2, GL_TEXTURE_2D, maps != nullptr ? maps->normals : none_);
}

}  // namespace welkin
