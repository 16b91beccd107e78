#include <welkin/pathtrace/fingerprint.h>

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace welkin {
namespace {

constexpr std::uint64_t mixed(std::uint64_t v) {  // the finaliser of MurmurHash3 (Appleby 2011)
  v = (v ^ (v >> 33)) * 0xff51afd7ed558ccdull;
  v = (v ^ (v >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return v ^ (v >> 33);
}

class Hash {
 public:
  std::uint64_t value() const { return value_; }

  template <class T>
  void add(const T& number) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof number);
    value_ = mixed(value_ ^ (bits + sizeof number)) + 0x9e3779b97f4a7c15ull;
  }
  // Vectors of types without padding only: numbers, Vec2f, Vec3f, triangles.
  template <class T>
  void add_array(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(values.size());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    value_ = content_hash({bytes, values.size() * sizeof(T)}, value_);
  }
  template <class... Numbers>
  void add_all(const Numbers&... numbers) {
    (add(numbers), ...);
  }

 private:
  std::uint64_t value_ = 0x77656c6b696eull;
};

void add(Hash& hash, Vec3f v) { hash.add_all(v.x, v.y, v.z); }
void add(Hash& hash, Rgb c) { hash.add_all(c.r, c.g, c.b); }
void add(Hash& hash, const Affine& a) {
  for (const Vec3f& v : {a.x, a.y, a.z, a.origin}) add(hash, v);
}
void add(Hash& hash, const Image& image) {
  hash.add_all(image.width, image.height, image.channels);
  hash.add_array(image.pixels);
}
void add(Hash& hash, const TextureUse& use) {
  hash.add_all(use.texture, use.texcoord, use.offset.x, use.offset.y, use.scale.x, use.scale.y,
               use.rotation_radians, use.channel);
}
void add(Hash& hash, const Material& m) {
  hash.add_all(m.model, m.compensated, m.base_alpha, m.metallic, m.perceptual_roughness, m.anisotropy, m.ior,
               m.exponent, m.sigma_radians, m.double_sided, m.alpha_mode, m.alpha_cutoff, m.normal_scale);
  for (const Rgb& colour : {m.base_color, m.eta, m.k, m.emission}) add(hash, colour);
  for (const float c : m.lafortune_c) hash.add(c);
  for (const TextureUse* use : {&m.base_color_texture, &m.metallic_texture, &m.roughness_texture,
                                &m.normal_texture, &m.emission_texture})
    add(hash, *use);
}
void add(Hash& hash, const Mesh& mesh) {
  hash.add_array(mesh.positions);
  hash.add_array(mesh.normals);
  hash.add_array(mesh.tangents);
  hash.add_array(mesh.tangent_signs);
  for (const auto& texcoords : mesh.texcoords) hash.add_array(texcoords);
  hash.add_array(mesh.triangles);
  hash.add(mesh.material);
}
void add(Hash& hash, const PunctualLight& light) {
  hash.add_all(light.kind, light.inner_cone_radians, light.outer_cone_radians);
  add(hash, light.position);
  add(hash, light.direction);
  add(hash, light.intensity);
}

void add(Hash& hash, const Scene& scene) {
  hash.add_all(scene.textures.size(), scene.materials.size(), scene.meshes.size(), scene.instances.size(),
               scene.spheres.size(), scene.lights.size());
  for (const Texture& texture : scene.textures) {
    add(hash, texture.image);
    hash.add_all(texture.wrap_u, texture.wrap_v, texture.nearest);
  }
  for (const Material& material : scene.materials) add(hash, material);
  for (const Mesh& mesh : scene.meshes) add(hash, mesh);
  for (const Instance& instance : scene.instances) {
    hash.add(instance.mesh);
    add(hash, instance.to_world);
  }
  for (const Sphere& sphere : scene.spheres) {
    add(hash, sphere.centre);
    hash.add_all(sphere.radius, sphere.material);
  }
  for (const PunctualLight& light : scene.lights) add(hash, light);
}

void add(Hash& hash, const Camera& camera) {
  add(hash, camera.to_world);
  hash.add_all(camera.vertical_field_radians, camera.orthographic_height.has_value(),
               camera.orthographic_height.value_or(0));
}

void add(Hash& hash, const PictureOptions& options) {
  const IntegratorOptions& i = options.integrator;
  hash.add_all(options.size.width, options.size.height, options.target_error);
  if (options.target_error > 0) hash.add_all(options.samples, options.least_samples);
  hash.add_all(i.integrator, i.sampling, i.heuristic, i.max_bounces, i.roulette_bounce, i.occlusion_distance,
               i.occlusion_rays, i.clamp_indirect, i.show_environment, i.seed);
  if (!i.shadows) hash.add(i.shadows);
}

}  // namespace

std::uint64_t content_hash(std::span<const std::uint8_t> bytes, std::uint64_t seed) {
  std::uint64_t value = seed ^ bytes.size();
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = bytes.size() < sizeof word ? bytes.size() : sizeof word;
    std::memcpy(&word, bytes.data(), size);
    value = mixed(value ^ word) + 0x9e3779b97f4a7c15ull;
    bytes = bytes.subspan(size);
  }
  return mixed(value);
}

std::uint64_t picture_fingerprint(const Scene& scene, const Camera& camera, const Image* environment,
                                  const PictureOptions& options) {
  Hash hash;
  add(hash, scene);
  add(hash, camera);
  hash.add(environment != nullptr);
  if (environment) add(hash, *environment);
  add(hash, options);
  return hash.value();
}

}  // namespace welkin
