#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>
#include <welkin/realtime/view.h>
#include <welkin/scene/scene.h>

namespace welkin {

/// The vertices of a mesh in OpenGL: attributes as mesh.vert has them (0 position, 1 normal, 2 tangent and sign, 3 both texcoords).
struct GpuMesh {
  GlVertexArray array;
  GlBuffer vertices, indices;
  int index_count = 0;
};

/// One mesh at one place. `to_world` may be changed between frames (moving objects).
struct GpuDraw {
  int mesh = 0, material = 0;
  Affine to_world;
};

/// A scene in OpenGL. Spheres are finely cut into triangles. Normals and tangents that a mesh lacks are made.
struct GpuScene {
  std::vector<Material> materials;
  std::vector<GlTexture> textures;
  std::vector<GpuMesh> meshes;
  std::vector<GpuDraw> draws;
  GlTexture white;  ///< what stands in for a texture that a material lacks
  Bounds bounds;    ///< when it was uploaded
  std::uint64_t serial =
      0;  ///< another one for every upload: what is made from a scene is made again when it changes
};

/// Throws Error for a scene without geometry, and where OpenGL's memory is too small.
GpuScene upload_scene(const Scene& scene);

/// Sets the uniforms of surface.glsl that say what the material is; uses texture units 0 to 4.
void set_material(const Program& program, const GpuScene& scene, const Material& material);

/// Sets the uniforms of surface.glsl and mesh.vert that say where the eye is.
void set_view(const Program& program, const View& view);

/// Told of every material that draw_scene has set, before anything is drawn with it: for a technique's own uniforms and textures.
class MaterialListener {
 public:
  virtual ~MaterialListener() = default;
  virtual void material_set(const Program& program, int material) = 0;
};

/// Draws everything with a program whose vertex shader is mesh.vert or has its inputs: sets view, material and places. Sets culling off (both sides are
/// drawn) and the depth test on.
void draw_scene(const Program& program, const GpuScene& scene, const View& view,
                MaterialListener* listener = nullptr);

/// Texture units: 0 to 4 the material's, 5 to 9 the environment's (gpu_environment.h), from 10 to 15 the technique's own.
inline constexpr int first_technique_unit = 10;

}  // namespace welkin
