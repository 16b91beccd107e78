#pragma once
#include <memory>
#include <vector>

#include <welkin/brdf/scatter/energy_table.h>
#include <welkin/brdf/scatter/scatter.h>
#include <welkin/raytrace/surface.h>

// From a surface and its material to the BRDF there, in the frame in which it is used.

namespace welkin {

/// A material's BRDF with what its textures change left at the factors.
struct ShadingMaterial {
  Scatter scatter;
  const Material* material = nullptr;
  bool textured = false;  ///< color, metallic or roughness
  bool normal_mapped = false;
  bool emits = false;
};

/// Immutable; keeps the energy tables that its Scatters point to.
class ShadingMaterials {
 public:
  explicit ShadingMaterials(const Scene& scene);
  const ShadingMaterial& operator[](int material) const { return materials_[material]; }

 private:
  std::vector<ShadingMaterial> materials_;
  std::vector<std::unique_ptr<EnergyTable>> energies_;
};

/// A surface seen from one side, ready to reflect.
struct ShadingPoint {
  Surface surface;
  LocalFrame frame;  ///< its normal is on the viewer's side, normal map included
  Vec3f facing;      ///< the geometric normal, on the viewer's side
  Vec3f view;        ///< local, towards the viewer; z > 0
  const Scatter* scatter = nullptr;
  Scatter textured;  ///< what `scatter` points to where textures count

  ShadingPoint() = default;
  ShadingPoint(const ShadingPoint&) = delete;
  ShadingPoint& operator=(const ShadingPoint&) = delete;
  /// Whether light from there can be reflected: above the geometric surface. Shading normals that lean do not let light
  /// through the surface.
  bool faces(Vec3f light_world) const { return dot(light_world, facing) > 0; }
};

/// Fills `point`, whose surface is set, for a ray of this direction.
void prepare_shading(const Scene& scene, const ShadingMaterials& materials, Vec3f ray_direction,
                     ShadingPoint& point);

}  // namespace welkin
