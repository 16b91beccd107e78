#include <welkin/realtime/gpu_scene.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include <welkin/error.h>
#include <welkin/image/srgb.h>
#include <welkin/scene/mesh_repair.h>

namespace welkin {
namespace {

struct Vertex {
  Vec3f position, normal, tangent;
  float sign;
  Vec2f texcoords[2];
};
static_assert(sizeof(Vertex) == 14 * sizeof(float));

template <class T>
T value_or(const std::vector<T>& values, std::size_t i, T missing) {
  return values.empty() ? missing : values[i];
}

std::vector<Vertex> interleave(const Mesh& mesh) {
  std::vector<Vertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = {mesh.positions[i],
                   value_or(mesh.normals, i, Vec3f{0, 1, 0}),
                   value_or(mesh.tangents, i, Vec3f{}),
                   value_or(mesh.tangent_signs, i, 1.0f),
                   {value_or(mesh.texcoords[0], i, Vec2f{}), value_or(mesh.texcoords[1], i, Vec2f{})}};
  }
  return vertices;
}

void set_attribute(GLuint place, int count, std::size_t offset) {
  glEnableVertexAttribArray(place);
  glVertexAttribPointer(place, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offset));
}

GpuMesh upload_mesh(const Mesh& mesh) {
  GpuMesh gpu{GlVertexArray::make(), GlBuffer::make(), GlBuffer::make(),
              static_cast<int>(3 * mesh.triangles.size())};
  const auto vertices = interleave(mesh);
  glBindVertexArray(gpu.array.name());
  glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(12 * mesh.triangles.size()),
               mesh.triangles.data(), GL_STATIC_DRAW);
  set_attribute(0, 3, offsetof(Vertex, position));
  set_attribute(1, 3, offsetof(Vertex, normal));
  set_attribute(2, 4, offsetof(Vertex, tangent));
  set_attribute(3, 4, offsetof(Vertex, texcoords));
  glBindVertexArray(0);
  check_gl("uploading a mesh");
  return gpu;
}

// A unit sphere; 2 sin^2(pi / 256) = 3e-4 of its radius is the farthest that an edge lies inside. Texture coordinates and tangents
// are the path tracer's (surface.cpp): u and v as equirectangular maps have them, tangents along u, which runs leftwards seen
// from outside. The seam is at -X, the poles are a row of vertices.
Mesh unit_sphere() {
  constexpr std::uint32_t rows = 128, columns = 256, stride = columns + 1;
  Mesh sphere;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const Vec2f uv{static_cast<float>(i) / columns, static_cast<float>(j) / rows};
      const float theta = std::numbers::pi_v<float> * uv.y, phi = std::numbers::pi_v<float> * (2 * uv.x - 1);
      const float across = j == 0 || j == rows ? 0 : std::sin(theta);
      sphere.positions.push_back({across * std::cos(phi), std::cos(theta), across * std::sin(phi)});
      sphere.tangents.push_back({-std::sin(phi), 0, std::cos(phi)});
      sphere.texcoords[0].push_back(uv);
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * stride + i, below = a + stride;
      if (j > 0) sphere.triangles.push_back({a, a + 1, below});
      if (j + 1 < rows) sphere.triangles.push_back({a + 1, below + 1, below});
    }
  }
  sphere.normals = sphere.positions;
  sphere.tangent_signs.assign(sphere.positions.size(), -1.0f);
  sphere.texcoords[1] = sphere.texcoords[0];
  return sphere;
}

bool has_normal_map(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<std::size_t>(mesh.material)].normal_texture.texture >= 0;
}

// Flat normals where a mesh has none: every triangle gets corners of its own.
Mesh with_flat_normals(const Mesh& mesh) {
  Mesh flat;
  flat.material = mesh.material;
  for (const auto& triangle : mesh.triangles) {
    const Vec3f a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]],
                c = mesh.positions[triangle[2]];
    const Vec3f across = cross(b - a, c - a);
    const float size = length(across);
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    for (const std::uint32_t corner : triangle) {
      flat.positions.push_back(mesh.positions[corner]);
      flat.normals.push_back(size > 0 ? (1 / size) * across : Vec3f{0, 1, 0});
      for (int set = 0; set < 2; ++set)
        if (!mesh.texcoords[set].empty()) flat.texcoords[set].push_back(mesh.texcoords[set][corner]);
    }
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  return flat;
}

Mesh complete(const Scene& scene, const Mesh& original) {
  Mesh mesh = original.normals.empty() ? with_flat_normals(original) : original;
  if (mesh.tangents.empty() && has_normal_map(scene, original)) {
    const int set = scene.materials[static_cast<std::size_t>(original.material)].normal_texture.texcoord;
    if (!mesh.texcoords[static_cast<std::size_t>(set)].empty()) make_tangents(mesh, set);
  }
  return mesh;
}

// The texture as 8-bit codes, colours by the sRGB curve or plain, alpha plain; one channel stands for all three colours. Nothing
// where some value is not within a tenth of a step of a code: files of 8 bits come back as what they were, everything else keeps its
// half floats, in twice the memory.
std::optional<std::vector<std::uint8_t>> as_codes(const Image& image, bool srgb) {
  const int channels = image.channels;
  std::vector<std::uint8_t> codes(image.pixels.size() / static_cast<std::size_t>(channels) * 4, 255);
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::size_t c = i % 4;
    if (c == 3 && channels < 4) continue;
    const float value = image.pixels[i / 4 * static_cast<std::size_t>(channels) + (channels == 1 ? 0 : c)];
    if (!(value >= 0 && value <= 1)) return std::nullopt;
    const double code = 255 * (srgb && c < 3 ? linear_to_srgb(value) : double{value});
    if (std::abs(code - std::round(code)) > 0.1) return std::nullopt;
    codes[i] = static_cast<std::uint8_t>(std::lround(code));
  }
  return codes;
}

// One channel stands for all three colours.
Image with_colours(const Image& image) {
  if (image.channels != 1) return image;
  Image gray(image.width, image.height, 3);
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) gray.pixels[i] = image.pixels[i / 3];
  return gray;
}

GlTexture upload_texture(const Texture& texture) {
  TextureDesc desc{texture.image.width, texture.image.height};
  desc.linear = !texture.nearest;
  GlTexture uploaded;
  for (const bool srgb : {false, true}) {
    const auto codes =
        !uploaded && texture.image.channels != 2 ? as_codes(texture.image, srgb) : std::nullopt;
    if (!codes) continue;
    desc.format = srgb ? TexelFormat::srgb8_alpha8 : TexelFormat::rgba8;
    uploaded = upload_bytes(*codes, desc, true);
  }
  if (!uploaded) uploaded = upload_image(with_colours(texture.image), desc, true);
  const auto wrap = [](TextureWrap w) {
    return w == TextureWrap::repeat  ? GL_REPEAT
           : w == TextureWrap::clamp ? GL_CLAMP_TO_EDGE
                                     : GL_MIRRORED_REPEAT;
  };
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(texture.wrap_u));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(texture.wrap_v));
  return uploaded;
}

void upload_spheres(const Scene& scene, GpuScene& gpu) {
  if (scene.spheres.empty()) return;
  const int mesh = static_cast<int>(gpu.meshes.size());
  gpu.meshes.push_back(upload_mesh(unit_sphere()));
  for (const Sphere& sphere : scene.spheres) {
    const float r = sphere.radius;
    gpu.draws.push_back({mesh, sphere.material, {{r, 0, 0}, {0, r, 0}, {0, 0, r}, sphere.centre}});
  }
}

// power_lobe.glsl's.
int power_of(MaterialModel model) {
  return model == MaterialModel::phong ? 1 : model == MaterialModel::lafortune ? 2 : 0;
}

// surface.glsl's kinds.
constexpr int kind_coated = 0, kind_metal = 1, kind_diffuse = 2;

struct Coefficients {
  int kind = kind_metal;
  Rgb base{1, 1, 1}, f0{1, 1, 1}, f90{1, 1, 1};
  float roughness = 0;
};

Rgb conductor_f0(const Material& m) {
  const auto f0 = [](float eta, float k) {
    return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
  };
  return {f0(m.eta.r, m.k.r), f0(m.eta.g, m.k.g), f0(m.eta.b, m.k.b)};
}

// What an engine makes of each model, as welkin/pathtrace/image_based.cpp has it.
Coefficients coefficients_of(const Material& m) {
  const float widths = m.perceptual_roughness * std::pow(1 - m.anisotropy * m.anisotropy, 0.25f);
  switch (m.model) {
    case MaterialModel::metallic_roughness:
    case MaterialModel::coated_diffuse: return {kind_coated, m.base_color, {}, {}, widths};
    case MaterialModel::lambert:
    case MaterialModel::oren_nayar: return {kind_diffuse, m.base_color, {0, 0, 0}, {0, 0, 0}, 1};
    case MaterialModel::phong:
    case MaterialModel::blinn_phong:
    case MaterialModel::lafortune:
      return {kind_metal, m.base_color, {1, 1, 1}, {1, 1, 1}, std::pow(2 / (m.exponent + 2), 0.25f)};
    case MaterialModel::ggx: return {kind_metal, m.base_color, {1, 1, 1}, {1, 1, 1}, widths};
    case MaterialModel::ggx_conductor: return {kind_metal, {1, 1, 1}, conductor_f0(m), {1, 1, 1}, widths};
    case MaterialModel::mirror: return {kind_metal, m.base_color, {1, 1, 1}, m.base_color, 0};
    case MaterialModel::conductor: return {kind_metal, {1, 1, 1}, conductor_f0(m), {1, 1, 1}, 0};
    case MaterialModel::dielectric: break;
  }
  const float f = (m.ior - 1) / (m.ior + 1);
  return {kind_metal, {1, 1, 1}, {f * f, f * f, f * f}, {1, 1, 1}, 0};
}

// KHR_texture_transform as two rows: offset * rotation * scale.
void append_uv(std::vector<Vec3f>& rows, const TextureUse& use) {
  const float c = std::cos(use.rotation_radians), s = std::sin(use.rotation_radians);
  rows.push_back({c * use.scale.x, s * use.scale.y, use.offset.x});
  rows.push_back({-s * use.scale.x, c * use.scale.y, use.offset.y});
}

void set_maps(const Program& program, const GpuScene& scene, const Material& m) {
  const TextureUse* uses[5] = {&m.base_color_texture, &m.metallic_texture, &m.roughness_texture,
                               &m.normal_texture, &m.emission_texture};
  static constexpr const char* names[5] = {"base_color_map", "metallic_map", "roughness_map", "normal_map",
                                           "emission_map"};
  int bits = 0;
  std::vector<Vec3f> rows;
  for (int i = 0; i < 5; ++i) {
    const bool used = uses[i]->texture >= 0;
    bits |= used ? 1 << i : 0;
    append_uv(rows, *uses[i]);
    program.set_texture(names[i], i, GL_TEXTURE_2D,
                        used ? scene.textures[static_cast<std::size_t>(uses[i]->texture)] : scene.white);
  }
  program.set("material_maps", bits);
  program.set_vec3_array("material_uv", rows);
  program.set_ivec4("material_texcoord", uses[0]->texcoord, uses[1]->texcoord, uses[2]->texcoord,
                    uses[3]->texcoord);
  program.set("material_emission_texcoord", m.emission_texture.texcoord);
  program.set("material_metallic_channel", m.metallic_texture.channel);
  program.set("material_roughness_channel", m.roughness_texture.channel);
}

}  // namespace

GpuScene upload_scene(const Scene& scene) {
  const auto bounds = scene_bounds(scene);
  if (!bounds) throw Error(scene.source, "has nothing that could be seen");
  static std::atomic<std::uint64_t> serial{0};
  GpuScene gpu;
  gpu.serial = ++serial;
  gpu.bounds = *bounds;
  gpu.materials = scene.materials;
  for (const Texture& texture : scene.textures) gpu.textures.push_back(upload_texture(texture));
  for (const Mesh& mesh : scene.meshes) gpu.meshes.push_back(upload_mesh(complete(scene, mesh)));
  for (const Instance& instance : scene.instances)
    gpu.draws.push_back(
        {instance.mesh, scene.meshes[static_cast<std::size_t>(instance.mesh)].material, instance.to_world});
  upload_spheres(scene, gpu);
  Image white(1, 1, 4);
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
  gpu.white = upload_image(white, {}, false);
  return gpu;
}

void set_material(const Program& program, const GpuScene& scene, const Material& m) {
  const Coefficients c = coefficients_of(m);
  const float ratio = (m.ior - 1) / (m.ior + 1), coat = ratio * ratio;
  program.set("material_kind", c.kind);
  program.set("material_base_color", c.base);
  program.set("material_f0", c.f0);
  program.set("material_f90", c.f90);
  program.set("material_emission", m.emission);
  program.set("material_coat", Vec2f{coat, std::min(1.0f, 50 * coat)});
  program.set("material_metallic", m.model == MaterialModel::metallic_roughness ? m.metallic : 0.0f);
  program.set("material_roughness", c.roughness);
  program.set("material_exponent", m.exponent);
  program.set("material_power", power_of(m.model));
  program.set("material_lafortune", Vec3f{m.lafortune_c[0], m.lafortune_c[1], m.lafortune_c[2]});
  program.set("material_normal_scale", m.normal_scale);
  program.set("material_compensated", m.compensated ? 1 : 0);
  program.set("material_double_sided", m.double_sided ? 1 : 0);
  program.set("material_alpha", m.base_alpha);
  program.set("material_alpha_cutoff", m.alpha_mode == AlphaMode::opaque ? -1.0f
                                       : m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff
                                                                         : 0.5f);
  set_maps(program, scene, m);
}

void set_view(const Program& program, const View& view) {
  program.set("world_to_clip", view.world_to_clip);
  program.set("world_to_view", view.world_to_view);
  program.set("eye_position", view.eye);
  program.set("view_direction", view.forward);
  program.set("orthographic", view.orthographic ? 1 : 0);
}

void draw_scene(const Program& program, const GpuScene& scene, const View& view, MaterialListener* listener) {
  program.use();
  set_view(program, view);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  int last_material = -1;
  for (const GpuDraw& draw : scene.draws) {
    if (draw.material != last_material) {
      set_material(program, scene, scene.materials[static_cast<std::size_t>(draw.material)]);
      if (listener != nullptr) listener->material_set(program, draw.material);
    }
    last_material = draw.material;
    const Affine& a = draw.to_world;
    const float side = determinant(a) < 0 ? -1.0f : 1.0f;
    program.set("to_world", to_matrix(a));
    program.set_linear("normal_to_world",
                       {side * cross(a.y, a.z), side * cross(a.z, a.x), side * cross(a.x, a.y), {}});
    glFrontFace(side < 0 ? GL_CW : GL_CCW);
    const GpuMesh& mesh = scene.meshes[static_cast<std::size_t>(draw.mesh)];
    glBindVertexArray(mesh.array.name());
    glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
  }
  glFrontFace(GL_CCW);
  glBindVertexArray(0);
}

}  // namespace welkin
