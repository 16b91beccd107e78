#pragma once
#include <vector>

#include <welkin/realtime/bump_maps.h>
#include <welkin/realtime/techniques/technique_list.h>

// What the techniques for normal maps share.

namespace welkin {

/// The statistics of all normal maps of a scene in OpenGL, bound material by material.
class GpuBumpMaps : public MaterialListener {
 public:
  /// Makes them where the scene is another one than last time.
  void update(const Frame& frame);
  /// Sets the uniforms of bump.glsl.
  void material_set(const Program& program, int material) override;

 private:
  struct Maps {
    GlTexture slopes, shapes, normals;
    Vec2f size;
    int texture = -1;
    float normal_scale = 1;
  };
  std::size_t find_or_make(const Texture& texture, int index, float normal_scale);

  std::uint64_t scene_serial_ = 0;
  std::vector<Maps> maps_;
  std::vector<int> of_material_;  // index into maps_, -1: no normal map
  GlTexture none_;
};

}  // namespace welkin
