#pragma once
#include <map>
#include <tuple>

#include <welkin/scene/gltf.h>
#include <welkin/scene/gltf_storage.h>
#include <welkin/scene/mesh_repair.h>

// From a parsed glTF file to a scene, in the order of these functions.

namespace welkin {

/// A glTF mesh where a node has it.
struct GltfPlacement {
  int mesh = 0;
  Affine to_world;
};

/// Cameras and lights go into the scene, meshes are returned. Throws Error where nodes form no tree. Instances without
/// volume are left out and counted.
std::vector<GltfPlacement> place_gltf_nodes(const GltfDocument& document, GltfStorage& storage, Scene& scene);

/// Materials, and the textures that they use.
void build_gltf_materials(const GltfDocument& document, GltfStorage& storage, const GltfPictures& pictures,
                          Scene& scene);

/// Meshes that are placed, and their instances.
void build_gltf_meshes(const GltfDocument& document, GltfStorage& storage,
                       const std::vector<GltfPlacement>& placements, Scene& scene);

}  // namespace welkin
