#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <welkin/geometry/affine.h>
#include <welkin/geometry/vec3f.h>
#include <welkin/image/image.h>
#include <welkin/image/rgb.h>

// A scene in memory: plain data, indices instead of pointers, as the importers (gltf.h, obj.h, ply.h) and the built-in
// scenes (built_in.h) make it. World frame: right-handed, +Y up, metres.

namespace welkin {

enum class TextureWrap : std::uint8_t { repeat, clamp, mirror };

/// Linear values (sRGB-encoded files are decoded on import), 1, 3 or 4 channels, row 0 at v = 0 (the top, as in glTF).
struct Texture {
  std::string name;
  Image image;
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool nearest = false;  ///< else bilinear
};

/// How a material uses a texture: texture < 0 means none. uv' = turned and scaled by KHR_texture_transform.
struct TextureUse {
  int texture = -1;
  int texcoord = 0;  ///< which of Mesh::texcoords, 0 or 1
  Vec2f offset{0, 0}, scale{1, 1};
  float rotation_radians = 0;
  int channel = 0;  ///< first channel to read, where one number is wanted
};

/// What a surface is made of. `metallic_roughness` is glTF's model and what files give; the others are for built-in
/// scenes and tests (welkin/brdf/scatter/scatter.h says which parameter each model reads).
enum class MaterialModel : std::uint8_t {
  metallic_roughness,
  lambert,
  oren_nayar,
  phong,
  blinn_phong,
  lafortune,
  ggx,
  ggx_conductor,
  mirror,
  conductor,
  dielectric,
  coated_diffuse,
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

struct Material {
  std::string name;
  MaterialModel model = MaterialModel::metallic_roughness;
  bool compensated = true;                       ///< energy lost between microfacets is given back
  Rgb base_color{1, 1, 1};                       ///< albedo, scale or F0, by model
  float base_alpha = 1;                          ///< coverage
  float metallic = 1, perceptual_roughness = 1;  ///< alpha = perceptual_roughness^2
  float anisotropy = 0;  ///< alpha_x = alpha (1 + a), alpha_y = alpha (1 - a); in (-1, 1)
  float ior = 1.5f;  ///< of the dielectric part; 1: it reflects nothing and the base is alone
  float exponent = 100, sigma_radians = 0;
  std::array<float, 3> lafortune_c{-1, -1, 1};
  Rgb eta{0.2f, 0.9f, 1.1f}, k{3.9f, 2.4f, 2.2f};
  Rgb emission{0, 0, 0};  ///< radiance, W/(sr m^2), from the front; from both sides if double_sided
  bool double_sided = false;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  float normal_scale = 1;
  TextureUse base_color_texture, metallic_texture, roughness_texture, normal_texture, emission_texture;
};

/// Triangles with one material. Empty arrays are attributes that the mesh lacks; others have positions.size() entries.
struct Mesh {
  std::string name;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                           ///< unit
  std::vector<Vec3f> tangents;                          ///< unit, along +u of the normal map's texcoord
  std::vector<float> tangent_signs;                     ///< +1 or -1: bitangent = sign cross(normal, tangent)
  std::array<std::vector<Vec2f>, 2> texcoords;          ///< glTF's: (0, 0) is the top left of the texture
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from the front
  int material = 0;
};

/// A mesh placed in the world.
struct Instance {
  int mesh = 0;
  Affine to_world;
};

/// An exact sphere, front outside. uv as the equirectangular map of its normal.
struct Sphere {
  Vec3f centre;
  float radius = 1;
  int material = 0;
};

/// Punctual lights as KHR_lights_punctual has them.
struct PunctualLight {
  enum class Kind : std::uint8_t { directional, point, spot };
  Kind kind = Kind::directional;
  Vec3f position;
  Vec3f direction{0, -1, 0};  ///< in which the light travels
  Rgb intensity{
      1, 1, 1};  ///< directional: irradiance on a surface across it (W/m^2); else radiant intensity (W/sr)
  float inner_cone_radians = 0, outer_cone_radians = 0.7853982f;
};

struct Camera {
  std::string name;
  Affine to_world;                           ///< looks along -z, y up, x right; no scale
  float vertical_field_radians = 0.7f;       ///< perspective
  std::optional<float> orthographic_height;  ///< metres; set: orthographic
  std::optional<float> width_over_height;    ///< of the picture that it was framed for
};

struct Scene {
  std::string source;  ///< the file or the built-in name
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Sphere> spheres;
  std::vector<PunctualLight> lights;
  std::vector<Camera> cameras;
  std::vector<std::string> warnings;  ///< what a file has and welkin does not use, or had to repair
};

/// Throws Error naming scene.source for the first thing that a renderer could trip over: an index out of range, an
/// attribute of the wrong length, a value that is not finite, a parameter out of its range, an instance without volume,
/// a world coordinate beyond 1e12 metres. Degenerate triangles pass. Importers return scenes that pass.
void check_scene(const Scene& scene);

/// Corners of a box around everything, world; the smallest one, but for rotated instances of a mesh that has several:
/// they count with their mesh's box. Nothing for a scene without geometry.
struct Bounds {
  Vec3f low, high;
};
std::optional<Bounds> scene_bounds(const Scene& scene);

/// A perspective camera that sees all of the bounds from the front (+Z), slightly from above.
Camera default_camera(const Bounds& bounds, double width_over_height);

}  // namespace welkin
