#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include <welkin/error.h>
#include <welkin/scene/scene.h>

namespace welkin {
namespace {

constexpr float largest_coordinate = 1e12f;

bool is_finite(float v) { return std::isfinite(v); }
bool is_finite(Vec2f v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool is_finite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_finite(const Affine& a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z) && is_finite(a.origin);
}
bool is_near(Vec3f p) {
  return std::fabs(p.x) <= largest_coordinate && std::fabs(p.y) <= largest_coordinate &&
         std::fabs(p.z) <= largest_coordinate;
}
bool is_light(Rgb c) {  // finite and not negative
  return c.r >= 0 && c.g >= 0 && c.b >= 0 && std::isfinite(c.r + c.g + c.b);
}
bool in_range(float v, float low, float high) { return v >= low && v <= high; }

// One thing of a scene, for messages.
struct Subject {
  const Scene& scene;
  const char* kind;
  std::size_t index;
  std::string_view name = {};

  void require(bool holds, std::string_view what) const {
    if (holds) return;
    const std::string quoted = name.empty() ? std::string() : fmt::format(" \"{}\"", name);
    throw Error(scene.source, fmt::format("{} {}{}: {}", kind, index, quoted, what));
  }
};

void check_texture(const Subject& subject, const Image& image) {
  subject.require(image.width > 0 && image.height > 0, "has no pixels");
  subject.require(image.channels == 1 || image.channels == 3 || image.channels == 4,
                  "has neither 1, 3 nor 4 channels");
  const std::size_t values = static_cast<std::size_t>(image.width) * image.height * image.channels;
  subject.require(image.pixels.size() == values, "its pixels do not fill its size");
  for (float value : image.pixels) subject.require(std::isfinite(value), "a pixel is not finite");
}

void check_use(const Subject& subject, const TextureUse& use, int channels) {
  if (use.texture < 0) return;
  const std::vector<Texture>& textures = subject.scene.textures;
  subject.require(use.texture < static_cast<int>(textures.size()),
                  "uses a texture that the scene does not have");
  subject.require(use.texcoord == 0 || use.texcoord == 1, "uses texture coordinates other than 0 and 1");
  subject.require(is_finite(use.offset) && is_finite(use.scale) && is_finite(use.rotation_radians),
                  "the placing of a texture is not finite");
  const int available = textures[use.texture].image.channels;
  subject.require(use.channel >= 0 && use.channel + channels <= available,
                  "uses a channel that its texture does not have");
}

void check_material(const Subject& subject, const Material& m) {
  subject.require(is_light(m.base_color), "its base color is negative or not finite");
  subject.require(is_light(m.emission), "its emission is negative or not finite");
  subject.require(in_range(m.base_alpha, 0, 1), "its alpha is not in [0, 1]");
  subject.require(in_range(m.metallic, 0, 1), "its metallic factor is not in [0, 1]");
  subject.require(in_range(m.perceptual_roughness, 0, 1), "its perceptual roughness is not in [0, 1]");
  subject.require(std::fabs(m.anisotropy) < 1, "its anisotropy is not in (-1, 1)");
  subject.require(in_range(m.ior, 1, 100), "its index of refraction is not in [1, 100]");
  subject.require(in_range(m.exponent, 0, 1e5f), "its exponent is not in [0, 1e5]");
  subject.require(in_range(m.sigma_radians, 0, 1.5707964f), "its sigma is not in [0, pi / 2]");
  for (float c : m.lafortune_c) subject.require(std::isfinite(c), "its Lafortune lobe is not finite");
  subject.require(is_light(m.eta) && is_light(m.k), "its complex index is negative or not finite");
  subject.require(in_range(m.alpha_cutoff, 0, 1e6f), "its alpha cut-off is negative or not finite");
  subject.require(is_finite(m.normal_scale), "its normal scale is not finite");
  check_use(subject, m.base_color_texture, 3);
  check_use(subject, m.emission_texture, 3);
  check_use(subject, m.normal_texture, 3);
  check_use(subject, m.metallic_texture, 1);
  check_use(subject, m.roughness_texture, 1);
}

template <class Value>
void check_attribute(const Subject& subject, const std::vector<Value>& values, std::size_t count,
                     const char* what) {
  if (values.empty()) return;
  subject.require(values.size() == count,
                  fmt::format("has {} {} for {} positions", values.size(), what, count));
  for (const Value& value : values) {
    subject.require(is_finite(value), fmt::format("a value of its {} is not finite", what));
  }
}

void check_mesh(const Subject& subject, const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  subject.require(mesh.material >= 0 && mesh.material < static_cast<int>(subject.scene.materials.size()),
                  "uses a material that the scene does not have");
  check_attribute(subject, mesh.positions, count, "positions");
  check_attribute(subject, mesh.normals, count, "normals");
  check_attribute(subject, mesh.tangents, count, "tangents");
  check_attribute(subject, mesh.tangent_signs, count, "tangent signs");
  subject.require(mesh.tangents.size() == mesh.tangent_signs.size(),
                  "has tangents without signs or signs alone");
  for (const auto& texcoords : mesh.texcoords)
    check_attribute(subject, texcoords, count, "texture coordinates");
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t vertex : triangle)
      subject.require(vertex < count, fmt::format("a triangle uses vertex {} of {}", vertex, count));
  }
}

void check_light(const Subject& subject, const PunctualLight& light) {
  subject.require(is_light(light.intensity), "its intensity is negative or not finite");
  subject.require(is_near(light.position), "its position is not finite or too far away");
  subject.require(std::fabs(length(light.direction) - 1) < 1e-3f, "its direction is not of unit length");
  subject.require(light.inner_cone_radians >= 0 && light.inner_cone_radians <= light.outer_cone_radians &&
                      light.outer_cone_radians <= 1.5707964f,
                  "its cones are not 0 <= inner <= outer <= pi / 2");
}

void check_camera(const Subject& subject, const Camera& camera) {
  subject.require(is_finite(camera.to_world) && is_near(camera.to_world.origin),
                  "its place is not finite or too far away");
  subject.require(std::fabs(std::fabs(determinant(camera.to_world)) - 1) < 1e-2f,
                  "its frame is not orthonormal");
  if (camera.orthographic_height) {
    subject.require(in_range(*camera.orthographic_height, 1e-12f, largest_coordinate),
                    "its height is not above 0");
  } else {
    subject.require(in_range(camera.vertical_field_radians, 1e-6f, 3.14f),
                    "its field of view is not in (0, pi)");
  }
  if (camera.width_over_height)
    subject.require(in_range(*camera.width_over_height, 1e-6f, 1e6f), "its aspect ratio is not above 0");
}

void check_instances(const Scene& scene) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Subject subject{scene, "instance", i};
    const Instance& instance = scene.instances[i];
    subject.require(instance.mesh >= 0 && instance.mesh < static_cast<int>(scene.meshes.size()),
                    "uses a mesh that the scene does not have");
    subject.require(is_finite(instance.to_world), "its transform is not finite");
    const float volume = determinant(instance.to_world);
    subject.require(volume != 0 && std::isfinite(volume), "its transform flattens it");
  }
}

void check_spheres(const Scene& scene) {
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Subject subject{scene, "sphere", i};
    const Sphere& sphere = scene.spheres[i];
    subject.require(is_finite(sphere.centre), "its centre is not finite");
    subject.require(in_range(sphere.radius, 1e-12f, largest_coordinate), "its radius is not above 0");
    subject.require(sphere.material >= 0 && sphere.material < static_cast<int>(scene.materials.size()),
                    "uses a material that the scene does not have");
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    check_texture({scene, "texture", i, scene.textures[i].name}, scene.textures[i].image);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    check_material({scene, "material", i, scene.materials[i].name}, scene.materials[i]);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    check_mesh({scene, "mesh", i, scene.meshes[i].name}, scene.meshes[i]);
  check_instances(scene);
  check_spheres(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) check_light({scene, "light", i}, scene.lights[i]);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    check_camera({scene, "camera", i, scene.cameras[i].name}, scene.cameras[i]);
  const std::optional<Bounds> bounds = scene_bounds(scene);
  if (bounds && !(is_near(bounds->low) && is_near(bounds->high)))
    throw Error(scene.source, "the scene reaches further than 1e12 metres");
}

}  // namespace welkin
