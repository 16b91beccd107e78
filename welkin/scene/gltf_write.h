#pragma once
#include <cstdint>
#include <vector>

#include <welkin/scene/scene.h>

namespace welkin {

/// A GLB of a scene, for other renderers: meshes with normals and first texture coordinates, instances, cameras, and of
/// materials the metallic-roughness factors, index, emission and sides. Spheres become meshes of 256 x 128 quads. No
/// textures and no lights are written. Materials of other models are their nearest: lambert and oren_nayar a rough
/// dielectric of index 1 (which is Lambert's), those with a coat or Fresnel's term a dielectric, all others metal.
std::vector<std::uint8_t> encode_glb(const Scene& scene);

}  // namespace welkin
