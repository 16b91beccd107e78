#include <welkin/pathtrace/shading.h>

#include <algorithm>
#include <cmath>

#include <welkin/raytrace/texture_lookup.h>

namespace welkin {
namespace {

ScatterModel scatter_model(MaterialModel model) {
  switch (model) {
    case MaterialModel::lambert: return ScatterModel::lambert;
    case MaterialModel::oren_nayar: return ScatterModel::oren_nayar;
    case MaterialModel::phong: return ScatterModel::phong;
    case MaterialModel::blinn_phong: return ScatterModel::blinn_phong;
    case MaterialModel::lafortune: return ScatterModel::lafortune;
    case MaterialModel::ggx: return ScatterModel::ggx;
    case MaterialModel::ggx_conductor: return ScatterModel::ggx_conductor;
    case MaterialModel::mirror: return ScatterModel::mirror;
    case MaterialModel::conductor: return ScatterModel::conductor;
    case MaterialModel::dielectric: return ScatterModel::dielectric;
    case MaterialModel::coated_diffuse: return ScatterModel::coated_diffuse;
    case MaterialModel::metallic_roughness: break;
  }
  return ScatterModel::metallic_roughness;
}

void set_widths(Scatter& scatter, float perceptual_roughness, float anisotropy) {
  const float alpha = perceptual_roughness * perceptual_roughness;
  scatter.alpha_x = std::clamp(alpha * (1 + anisotropy), 1e-3f, 1.0f);
  scatter.alpha_y = std::clamp(alpha * (1 - anisotropy), 1e-3f, 1.0f);
}

// Schlick's term keeps f90 = 1 down to an index of 1, where there is no interface and nothing to reflect. Below F0 = 0.02
// (index 1.33) f90 falls with F0, so that an index of 1 leaves the diffuse base alone.
bool has_dielectric_part(MaterialModel model) {
  return model == MaterialModel::metallic_roughness || model == MaterialModel::coated_diffuse;
}

Scatter plain_scatter(const Material& m) {
  Scatter scatter;
  scatter.model = scatter_model(m.model);
  scatter.compensated = m.compensated;
  scatter.color = m.base_color;
  const float ratio = (m.ior - 1) / (m.ior + 1);
  scatter.f0 = ratio * ratio;
  if (has_dielectric_part(m.model)) scatter.f90 = std::min(1.0f, 50 * scatter.f0);
  set_widths(scatter, m.perceptual_roughness, m.anisotropy);
  scatter.metallic = m.metallic;
  scatter.exponent = m.exponent;
  scatter.sigma_radians = m.sigma_radians;
  scatter.lafortune_c = m.lafortune_c;
  scatter.eta = m.eta;
  scatter.k = m.k;
  if (m.model == MaterialModel::dielectric) scatter.eta = {m.ior, m.ior, m.ior};
  return scatter;
}

void apply_textures(const Scene& scene, const Material& m, const Vec2f (&texcoords)[2], Scatter& scatter) {
  if (m.base_color_texture.texture >= 0) {
    const Texel texel = look_up(scene, m.base_color_texture, texcoords);
    scatter.color *= Rgb{texel[0], texel[1], texel[2]};
  }
  if (m.metallic_texture.texture >= 0) {
    scatter.metallic *= look_up(scene, m.metallic_texture, texcoords)[m.metallic_texture.channel];
  }
  if (m.roughness_texture.texture >= 0) {
    const float texel = look_up(scene, m.roughness_texture, texcoords)[m.roughness_texture.channel];
    set_widths(scatter, m.perceptual_roughness * texel, m.anisotropy);
  }
}

/// The normal of a normal map: (2 texel - 1) with x and y scaled, along the tangent, the bitangent of the map's handedness
/// and the interpolated normal.
Vec3f mapped_normal(const Scene& scene, const Material& m, const Surface& surface) {
  const Texel texel = look_up(scene, m.normal_texture, surface.texcoords);
  const float x = m.normal_scale * (2 * texel[0] - 1), y = m.normal_scale * (2 * texel[1] - 1);
  const float z = 2 * texel[2] - 1;
  const LocalFrame& f = surface.shading;
  const Vec3f normal = x * f.tangent + (surface.bitangent_sign * y) * f.bitangent + z * f.normal;
  const float squared = dot(normal, normal);
  return squared > 1e-12f ? (1 / std::sqrt(squared)) * normal : f.normal;
}

/// The normal, turned towards the viewer until it faces it by a cosine of 0.01 at least: a shading normal that looks away
/// has no meaning for a BRDF.
Vec3f towards_viewer(Vec3f normal, Vec3f view) {
  constexpr float least = 0.01f;
  const float cosine = dot(normal, view);
  return cosine >= least ? normal : normalized(normal + (least - cosine) * view);
}

}  // namespace

ShadingMaterials::ShadingMaterials(const Scene& scene) {
  for (const Material& m : scene.materials) {
    ShadingMaterial entry;
    entry.material = &m;
    entry.scatter = plain_scatter(m);
    entry.textured = m.base_color_texture.texture >= 0 || m.metallic_texture.texture >= 0 ||
                     m.roughness_texture.texture >= 0;
    entry.normal_mapped = m.normal_texture.texture >= 0;
    entry.emits = !is_black(m.emission);
    if (m.compensated && needs_energy_table(entry.scatter)) {
      energies_.push_back(std::make_unique<EnergyTable>(make_energy_table(entry.scatter)));
      entry.scatter.energy = energies_.back().get();
    }
    materials_.push_back(entry);
  }
}

void prepare_shading(const Scene& scene, const ShadingMaterials& materials, Vec3f ray_direction,
                     ShadingPoint& point) {
  const Surface& surface = point.surface;
  const ShadingMaterial& entry = materials[surface.material];
  point.scatter = &entry.scatter;
  if (entry.textured) {
    point.textured = entry.scatter;
    apply_textures(scene, *entry.material, surface.texcoords, point.textured);
    point.scatter = &point.textured;
  }
  const float side = surface.front ? 1.0f : -1.0f;
  point.facing = side * surface.geometric_normal;
  const Vec3f mapped =
      entry.normal_mapped ? mapped_normal(scene, *entry.material, surface) : surface.shading.normal;
  const Vec3f normal = towards_viewer(side * mapped, -ray_direction);
  if (normal == surface.shading.normal) {
    point.frame = surface.shading;
  } else {
    point.frame = make_frame(normal, surface.shading.tangent);
  }
  point.view = point.frame.to_local(-ray_direction);
}

}  // namespace welkin
