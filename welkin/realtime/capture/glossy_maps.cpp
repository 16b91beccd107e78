#include <welkin/realtime/capture/glossy_maps.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/realtime/capture/glossy_taps.h>
#include <welkin/realtime/gpu_scene.h>

namespace welkin {
namespace {

constexpr int source_unit = first_technique_unit, cube_unit = source_unit + 1, faces_unit = source_unit + 2;
constexpr float border_reach = 2;  // texels of a face and of its picture are the same
constexpr int narrowest = 8;       // texels an edge of the last filtered level
// What glossy.glsl calls them.
constexpr int kind_cube = 0, kind_faces = 1, kind_paraboloids = 2, kind_filtered = 3;

int full_chain(int size) {
  int levels = 1;
  while (size >> levels != 0) ++levels;
  return levels;
}

GlTexture make_picture_array(int size, int layers) {
  GlTexture texture = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, full_chain(size), GL_RGBA16F, size, size, layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  check_gl("making bordered pictures");
  return texture;
}

void set_levels(const GlTexture& cube, int first, int last) {
  bind_texture(source_unit, GL_TEXTURE_CUBE_MAP, cube);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BASE_LEVEL, first);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, last);
}

template <class DrawFace>
void draw_faces(const GlTexture& cube, int level, int size, const DrawFace& draw_face) {
  glViewport(0, 0, size, size);
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), cube.name(), level);
    draw_face(face);
  }
}

}  // namespace

bool GlossyMaps::filtered() const {
  return options_.method == GlossyMethod::quick || options_.method == GlossyMethod::importance;
}

bool GlossyMaps::pictures() const {
  return options_.method == GlossyMethod::bordered || options_.method == GlossyMethod::paraboloid ||
         (options_.method == GlossyMethod::box && options_.seams_shown);
}

GlossyMaps::GlossyMaps(const GlossyOptions& options)
    : options_(options), levels_(full_chain(options.size)), framebuffer_(GlFramebuffer::make()) {
  spreads_ = glossy_spreads();
  if (pictures()) {
    const bool paraboloid = options.method == GlossyMethod::paraboloid;
    reach_ = options.seams_shown ? 1 : border_reach;
    picture_size_ = options.seams_shown && !paraboloid ? options.size : 2 * options.size;
    pictures_ = make_picture_array(picture_size_, paraboloid ? 2 : 6);
    picture_ = Program("fullscreen.vert", "glossy_picture.frag");
  }
  if (!filtered()) return;
  const bool quick = options.method == GlossyMethod::quick;
  while (options.size >> filtered_levels_ >= narrowest) ++filtered_levels_;
  for (int level = 1; level < filtered_levels_; ++level) {
    // As glossy_filtered_level of glossy.glsl has it.
    const double spread = std::ldexp(static_cast<double>(spreads_.back()), level + 1 - filtered_levels_);
    const double roughness = roughness_of_spread(spread);
    taps_.push_back(quick ? make_quick_taps(roughness, options.taps, options.size)
                          : make_importance_taps(roughness, options.taps, options.size));
  }
  TextureDesc desc;
  desc.width = options.size;
  desc.levels = filtered_levels_;
  filtered_ = make_cube_texture(desc);
  taps_program_ = Program("fullscreen.vert", "glossy_taps.frag");
  if (quick) spline_ = Program("fullscreen.vert", "spline_mip.frag");
}

void GlossyMaps::draw_pictures(const GlTexture& cube, const Fullscreen& fullscreen) {
  const bool paraboloid = options_.method == GlossyMethod::paraboloid;
  glViewport(0, 0, picture_size_, picture_size_);
  picture_.use();
  picture_.set_texture("cube", source_unit, GL_TEXTURE_CUBE_MAP, cube);
  picture_.set("paraboloid", paraboloid ? 1 : 0);
  picture_.set("size", static_cast<float>(picture_size_));
  picture_.set("reach", reach_);
  for (int layer = 0; layer < (paraboloid ? 2 : 6); ++layer) {
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pictures_.name(), 0, layer);
    picture_.set("layer", layer);
    fullscreen.draw();
  }
  bind_texture(faces_unit, GL_TEXTURE_2D_ARRAY, pictures_);
  glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

// While a level is drawn only the one above it is visible to the sampler: WebGL refuses what might read what it writes.
void GlossyMaps::draw_splines(const GlTexture& cube, const Fullscreen& fullscreen) {
  spline_.use();
  spline_.set("finer", source_unit);
  for (int level = 1; level < levels_; ++level) {
    set_levels(cube, level - 1, level - 1);
    spline_.set("finer_size", static_cast<float>(options_.size >> (level - 1)));
    draw_faces(cube, level, options_.size >> level, [&](int face) {
      spline_.set("face", face);
      fullscreen.draw();
    });
  }
  set_levels(cube, 0, levels_ - 1);
}

void GlossyMaps::draw_filtered(const GlTexture& cube, const Fullscreen& fullscreen) {
  static const GlossyTaps mirror{{{0, 0, 1}}, {{0, 1, 0}}};
  taps_program_.use();
  taps_program_.set_texture("chain", source_unit, GL_TEXTURE_CUBE_MAP, cube);
  taps_program_.set("chain_size", static_cast<float>(options_.size));
  for (int level = 0; level < filtered_levels_; ++level) {
    const GlossyTaps& taps = level == 0 ? mirror : taps_[static_cast<std::size_t>(level - 1)];
    taps_program_.set("by_footprint", level > 0 && options_.method == GlossyMethod::quick ? 1 : 0);
    taps_program_.set("taps", static_cast<int>(taps.directions.size()));
    taps_program_.set_vec3_array("tap_directions", taps.directions);
    taps_program_.set_vec3_array("tap_sizes", taps.sizes);
    taps_program_.set("size", static_cast<float>(options_.size >> level));
    draw_faces(filtered_, level, options_.size >> level, [&](int face) {
      taps_program_.set("face", face);
      fullscreen.draw();
    });
  }
}

void GlossyMaps::update(const GlTexture& cube, const Fullscreen& fullscreen) {
  glDisable(GL_DEPTH_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (pictures()) draw_pictures(cube, fullscreen);
  if (options_.method == GlossyMethod::quick) {
    draw_splines(cube, fullscreen);
  } else if (!pictures()) {
    bind_texture(source_unit, GL_TEXTURE_CUBE_MAP, cube);
    glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
  }
  if (filtered()) draw_filtered(cube, fullscreen);
  check_gl("filtering glossy maps");
}

void GlossyMaps::set(const Program& program, const GlTexture& cube) const {
  program.set_texture("glossy_cube", cube_unit, GL_TEXTURE_CUBE_MAP, filtered() ? filtered_ : cube);
  program.set("glossy_faces", faces_unit);
  if (pictures()) bind_texture(faces_unit, GL_TEXTURE_2D_ARRAY, pictures_);
  const int kind = filtered()                                    ? kind_filtered
                   : !pictures()                                 ? kind_cube
                   : options_.method == GlossyMethod::paraboloid ? kind_paraboloids
                                                                 : kind_faces;
  program.set("glossy_kind", kind);
  program.set_float_array("glossy_spreads", spreads_);
  const float texels =
      pictures() ? static_cast<float>(picture_size_) / reach_ : static_cast<float>(options_.size);
  program.set("glossy_texels", texels);
  program.set("glossy_reach", reach_);
  // The tent of a look-up must not leave the border: half a face or radius at the last level.
  const int last = filtered()                            ? filtered_levels_ - 1
                   : pictures() && !options_.seams_shown ? levels_ - 2
                                                         : levels_ - 1;
  program.set("glossy_last_level", static_cast<float>(last));
}

}  // namespace welkin
