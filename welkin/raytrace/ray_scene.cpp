#include <welkin/raytrace/ray_scene.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include <welkin/error.h>
#include <welkin/raytrace/texture_lookup.h>

namespace welkin {
namespace {

/// What the filter of a geometry with holes needs: whose material it is, and where the texture coordinates are.
struct CutOut {
  const Scene* scene = nullptr;
  const Mesh* mesh = nullptr;  ///< none: the spheres
};

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

[[noreturn]] void refuse(const Scene& scene, const std::string& what) { throw Error(scene.source, what); }

std::uint32_t bits_of(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::uint32_t mixed(std::uint32_t hash, std::uint32_t word) {
  hash = (hash ^ word) * 0x9e3779b1u;
  return (hash ^ (hash >> 15)) * 0x85ebca77u;
}

Vec2f interpolated(const std::vector<Vec2f>& values, const std::array<std::uint32_t, 3>& corners, float u,
                   float v) {
  if (values.empty()) return {};
  return (1 - u - v) * values[corners[0]] + u * values[corners[1]] + v * values[corners[2]];
}

/// A ray and a hit of those that Embree hands to a filter.
struct Candidate {
  Vec3f origin, direction;
  float distance = 0, u = 0, v = 0;
  unsigned object = 0, primitive = 0;
};

Candidate candidate(const RTCFilterFunctionNArguments& a, unsigned i) {
  const unsigned n = a.N, instance = RTCHitN_instID(a.hit, n, i, 0);
  return {{RTCRayN_org_x(a.ray, n, i), RTCRayN_org_y(a.ray, n, i), RTCRayN_org_z(a.ray, n, i)},
          {RTCRayN_dir_x(a.ray, n, i), RTCRayN_dir_y(a.ray, n, i), RTCRayN_dir_z(a.ray, n, i)},
          RTCRayN_tfar(a.ray, n, i),
          RTCHitN_u(a.hit, n, i),
          RTCHitN_v(a.hit, n, i),
          instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(a.hit, n, i),
          RTCHitN_primID(a.hit, n, i)};
}

/// A number in [0, 1) that is the same for the same ray and primitive, and else as good as random.
float ray_hash(const Candidate& c) {
  std::uint32_t hash = mixed(c.object, c.primitive);
  for (const float value :
       {c.origin.x, c.origin.y, c.origin.z, c.direction.x, c.direction.y, c.direction.z}) {
    hash = mixed(hash, bits_of(value));
  }
  hash ^= hash >> 13;
  return static_cast<float>(hash >> 8) * 0x1p-24f;
}

bool is_hole(const CutOut& cut, const Candidate& c) {
  const Scene& scene = *cut.scene;
  Vec2f texcoords[2];
  int material_index = 0;
  if (cut.mesh != nullptr) {
    material_index = cut.mesh->material;
    const auto& corners = cut.mesh->triangles[c.primitive];
    for (int i = 0; i < 2; ++i) texcoords[i] = interpolated(cut.mesh->texcoords[i], corners, c.u, c.v);
  } else {
    const Sphere& sphere = scene.spheres[c.primitive];
    material_index = sphere.material;
    texcoords[0] = texcoords[1] =
        sphere_texcoord(normalized(c.origin + c.distance * c.direction - sphere.centre));
  }
  const Material& material = scene.materials[material_index];
  if (material.alpha_mode == AlphaMode::opaque) return false;
  const float coverage = coverage_at(scene, material, texcoords);
  if (material.alpha_mode == AlphaMode::mask) return coverage < material.alpha_cutoff;
  return coverage <= ray_hash(c);
}

/// Embree's filter: says that there is no hit where the material has a hole.
void pass_holes(const RTCFilterFunctionNArguments* arguments) {
  const CutOut& cut = *static_cast<const CutOut*>(arguments->geometryUserPtr);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == -1 && is_hole(cut, candidate(*arguments, i))) arguments->valid[i] = 0;
  }
}

bool has_holes(const Scene& scene, int material) {
  return scene.materials[material].alpha_mode != AlphaMode::opaque;
}

/// The largest row sum of the inverse's absolute values: how much larger coordinates can become on their way into the
/// frame of an instance. Infinite where there is no inverse.
float magnification(const Affine& a) {
  if (!(std::abs(determinant(a)) > 1e-30f)) return INFINITY;
  const Affine b = inverse(a);
  const float rows[3] = {std::abs(b.x.x) + std::abs(b.y.x) + std::abs(b.z.x),
                         std::abs(b.x.y) + std::abs(b.y.y) + std::abs(b.z.y),
                         std::abs(b.x.z) + std::abs(b.y.z) + std::abs(b.z.z)};
  return std::max({rows[0], rows[1], rows[2]});
}

/// Rounding of a ray's way into the frame of an instance: Embree inverts the matrix M in single precision and applies it
/// to the origin; a relative error of some units of rounding in every factor comes back through M as at most that times
/// | |M| |M^-1| | (componentwise absolute values, largest row sum) of the coordinates.
float transform_error(const Affine& a) {
  const Affine b = inverse(a);
  const float rows[3][3] = {{a.x.x, a.y.x, a.z.x}, {a.x.y, a.y.y, a.z.y}, {a.x.z, a.y.z, a.z.z}};
  const Vec3f columns[3] = {b.x, b.y, b.z};
  float largest = 0;
  for (const auto& row : rows) {
    float sum = 0;
    for (const Vec3f& c : columns) {
      sum += std::abs(row[0] * c.x) + std::abs(row[1] * c.y) + std::abs(row[2] * c.z);
    }
    largest = std::max(largest, sum);
  }
  return 16 * 0x1p-24f * largest;
}

PlacedMesh placed_mesh(const Scene& scene, const Instance& instance, bool in_world) {
  PlacedMesh placed;
  const Affine& a = instance.to_world;
  placed.mesh = &scene.meshes[instance.mesh];
  placed.to_world = a;
  placed.unmoved =
      a.x == Vec3f{1, 0, 0} && a.y == Vec3f{0, 1, 0} && a.z == Vec3f{0, 0, 1} && a.origin == Vec3f{0, 0, 0};
  const float volume = determinant(a);
  placed.mirrored = volume < 0;
  // What cannot be inverted has to be flattened (into nothing that is ever hit, or into a sheet), and what shrinks by more
  // than 2e5 is: in its frame the world would be too large for floats.
  placed.in_world = in_world || !(magnification(a) < 2e5f);
  if (!placed.in_world) placed.transform_error = transform_error(a);
  placed.origin_size = std::max(std::max(std::abs(a.origin.x), std::abs(a.origin.y)), std::abs(a.origin.z));
  return placed;
}

}  // namespace

struct RayScene::Tree {
  const Scene* scene = nullptr;
  Owned<RTCDevice> device;
  Owned<RTCScene> top;
  std::vector<Owned<RTCScene>> mesh_scenes;  ///< by mesh; null where no instance needs it
  std::vector<const Vec3f*> mesh_positions;  ///< of those scenes
  std::vector<PlacedMesh> placed;
  float reach = 0x1p60f;         ///< rays that start beyond are not traced
  std::vector<CutOut> cut_outs;  ///< by mesh, then the spheres'

  explicit Tree(const Scene& of);

 private:
  void check(bool good) const;
  Owned<RTCScene> new_scene() const;
  Owned<RTCGeometry> new_geometry(RTCGeometryType type) const;
  void commit(RTCScene tree) const;
  const Vec3f* add_triangles(RTCScene tree, unsigned id, const Mesh& mesh, const Affine* to_world);
  void add_own_tree(int mesh);
  void add_instance(unsigned id, RTCScene tree, const Affine& to_world);
  void add_spheres();
  void set_filter(RTCGeometry geometry, CutOut& cut) const;
};

RayScene::Tree::Tree(const Scene& of) : scene(&of) {
  device.reset(rtcNewDevice(nullptr));
  if (device == nullptr) refuse(of, "Embree does not start");
  top = new_scene();
  std::vector<std::uint32_t> uses(of.meshes.size());
  for (const Instance& instance : of.instances) ++uses[instance.mesh];
  mesh_scenes.resize(of.meshes.size());
  mesh_positions.resize(of.meshes.size());
  cut_outs.resize(of.meshes.size() + 1);
  for (std::size_t i = 0; i < of.meshes.size(); ++i) cut_outs[i] = {&of, &of.meshes[i]};
  cut_outs.back() = {&of, nullptr};
  placed.reserve(of.instances.size());
  for (unsigned i = 0; i < of.instances.size(); ++i) {
    const Instance& instance = of.instances[i];
    PlacedMesh item = placed_mesh(of, instance, uses[instance.mesh] == 1);
    if (item.in_world) {
      item.positions = add_triangles(top.get(), i, *item.mesh, &instance.to_world);
    } else {
      if (mesh_scenes[instance.mesh] == nullptr) add_own_tree(instance.mesh);
      add_instance(i, mesh_scenes[instance.mesh].get(), instance.to_world);
      reach = std::min(reach, 0x1p59f / std::max(magnification(instance.to_world), 1.0f));
      item.positions = mesh_positions[instance.mesh];
    }
    placed.push_back(item);
  }
  add_spheres();
  commit(top.get());
}

void RayScene::Tree::check(bool good) const {
  const RTCError error = rtcGetDeviceError(device.get());
  if (good && error == RTC_ERROR_NONE) return;
  refuse(*scene, error == RTC_ERROR_OUT_OF_MEMORY ? "memory does not suffice for the ray tracing tree"
                                                  : "Embree cannot build the ray tracing tree");
}

Owned<RTCScene> RayScene::Tree::new_scene() const {
  Owned<RTCScene> made(rtcNewScene(device.get()));
  check(made != nullptr);
  rtcSetSceneFlags(made.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_HIGH);
  return made;
}

Owned<RTCGeometry> RayScene::Tree::new_geometry(RTCGeometryType type) const {
  Owned<RTCGeometry> made(rtcNewGeometry(device.get(), type));
  check(made != nullptr);
  return made;
}

void RayScene::Tree::commit(RTCScene tree) const {
  rtcCommitScene(tree);
  check(true);
}

void RayScene::Tree::set_filter(RTCGeometry geometry, CutOut& cut) const {
  rtcSetGeometryUserData(geometry, &cut);
  rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
  rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
}

const Vec3f* RayScene::Tree::add_triangles(RTCScene tree, unsigned id, const Mesh& mesh,
                                           const Affine* to_world) {
  const Owned<RTCGeometry> owned = new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
  RTCGeometry geometry = owned.get();
  Vec3f* positions = nullptr;
  if (!mesh.triangles.empty() && !mesh.positions.empty()) {
    positions = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.positions.size()));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof mesh.triangles[0], mesh.triangles.size());
    check(positions != nullptr && triangles != nullptr);
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      positions[i] = to_world == nullptr ? mesh.positions[i] : to_world->point(mesh.positions[i]);
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    if (has_holes(*scene, mesh.material)) set_filter(geometry, cut_outs[&mesh - scene->meshes.data()]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tree, geometry, id);
  }
  return positions;
}

void RayScene::Tree::add_own_tree(int mesh) {
  mesh_scenes[mesh] = new_scene();
  mesh_positions[mesh] = add_triangles(mesh_scenes[mesh].get(), 0, scene->meshes[mesh], nullptr);
  commit(mesh_scenes[mesh].get());
}

void RayScene::Tree::add_instance(unsigned id, RTCScene tree, const Affine& a) {
  const Owned<RTCGeometry> owned = new_geometry(RTC_GEOMETRY_TYPE_INSTANCE);
  RTCGeometry geometry = owned.get();
  const float columns[12] = {a.x.x, a.x.y, a.x.z, a.y.x,      a.y.y,      a.y.z,
                             a.z.x, a.z.y, a.z.z, a.origin.x, a.origin.y, a.origin.z};
  rtcSetGeometryInstancedScene(geometry, tree);
  rtcSetGeometryTimeStepCount(geometry, 1);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(top.get(), geometry, id);
}

void RayScene::Tree::add_spheres() {
  const std::vector<Sphere>& spheres = scene->spheres;
  if (spheres.empty()) return;
  const Owned<RTCGeometry> owned = new_geometry(RTC_GEOMETRY_TYPE_SPHERE_POINT);
  RTCGeometry geometry = owned.get();
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres.size()));
  check(points != nullptr);
  bool holes = false;
  for (const Sphere& sphere : spheres) {
    for (const float value : {sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius}) {
      *points++ = value;
    }
    holes = holes || has_holes(*scene, sphere.material);
  }
  if (holes) set_filter(geometry, cut_outs.back());
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(top.get(), geometry, static_cast<unsigned>(scene->instances.size()));
}

RayScene::RayScene(const Scene& scene) : tree_(std::make_unique<Tree>(scene)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

const Scene& RayScene::scene() const { return *tree_->scene; }
const std::vector<PlacedMesh>& RayScene::placed() const { return tree_->placed; }

namespace {

/// What Embree found, as a Hit. Spheres are all one geometry, behind those of the instances.
Hit hit_of(float distance, unsigned geometry, unsigned instance, unsigned primitive, float u, float v,
           std::size_t instances) {
  Hit hit{distance, geometry, primitive, u, v};
  if (instance != RTC_INVALID_GEOMETRY_ID) {
    hit.object = instance;
  } else if (geometry == instances) {
    hit.object += primitive;
    hit.triangle = 0;
  }
  return hit;
}

/// Embree wants finite rays whose coordinates are below 2^60, in the world and in the frames of instances (`reach` is what
/// that leaves in the world). With its assertions on, as distributions build it, any other ends the program. They come of
/// arithmetic beyond the range of floats, and meet nothing.
bool is_traceable(const Ray& ray, float reach) {
  const auto size = [](Vec3f v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  return size(ray.origin) + size(ray.direction) < reach && ray.far >= 0;  // false for NaN
}

RTCRay single(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.near,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.far,
          ~0u,
          0,
          0};
}

/// Fills the first lanes of Embree's packet; the others are off.
template <class Packet>
void fill(std::span<const Ray> rays, float reach, Packet& packet, int* valid, std::size_t lanes) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    valid[i] = i < rays.size() && is_traceable(ray, reach) ? -1 : 0;
    packet.org_x[i] = ray.origin.x;
    packet.org_y[i] = ray.origin.y;
    packet.org_z[i] = ray.origin.z;
    packet.tnear[i] = ray.near;
    packet.dir_x[i] = ray.direction.x;
    packet.dir_y[i] = ray.direction.y;
    packet.dir_z[i] = ray.direction.z;
    packet.time[i] = 0;
    packet.tfar[i] = ray.far;
    packet.mask[i] = ~0u;
    packet.id[i] = 0;
    packet.flags[i] = 0;
  }
}

template <class Packet, std::size_t lanes, class Trace>
std::uint32_t closest_of(std::span<const Ray> rays, float reach, Hit* hits, std::size_t instances,
                         Trace trace) {
  Packet packet;
  alignas(64) int valid[lanes];
  fill(rays, reach, packet.ray, valid, lanes);
  for (std::size_t i = 0; i < lanes; ++i) {
    packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  trace(valid, packet);
  std::uint32_t met = 0;
  const auto& found = packet.hit;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (found.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    met |= 1u << i;
    hits[i] = hit_of(packet.ray.tfar[i], found.geomID[i], found.instID[0][i], found.primID[i], found.u[i],
                     found.v[i], instances);
  }
  return met;
}

template <class Packet, std::size_t lanes, class Trace>
std::uint32_t occluded_of(std::span<const Ray> rays, float reach, Trace trace) {
  Packet packet;
  alignas(64) int valid[lanes];
  fill(rays, reach, packet, valid, lanes);
  trace(valid, packet);
  std::uint32_t met = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) met |= (packet.tfar[i] < 0 ? 1u : 0u) << i;
  return met;
}

}  // namespace

std::optional<Hit> RayScene::closest(const Ray& ray) const {
  if (!is_traceable(ray, tree_->reach)) return std::nullopt;
  RTCRayHit query;
  query.ray = single(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(tree_->top.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return hit_of(query.ray.tfar, query.hit.geomID, query.hit.instID[0], query.hit.primID, query.hit.u,
                query.hit.v, tree_->placed.size());
}

bool RayScene::occluded(const Ray& ray) const {
  if (!is_traceable(ray, tree_->reach)) return false;
  RTCRay query = single(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tree_->top.get(), &context, &query);
  return query.tfar < 0;
}

std::uint32_t RayScene::closest(std::span<const Ray> rays, Hit* hits, RayKind kind) const {
  assert(rays.size() <= batch_size);
  if (rays.size() <= 1) {
    const std::optional<Hit> hit = rays.empty() ? std::nullopt : closest(rays[0]);
    if (hit) hits[0] = *hit;
    return hit ? 1 : 0;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (kind == RayKind::side_by_side) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCScene top = tree_->top.get();
  const std::size_t instances = tree_->placed.size();
  if (rays.size() <= 8) {
    return closest_of<RTCRayHit8, 8>(
        rays, tree_->reach, hits, instances,
        [&](const int* valid, RTCRayHit8& packet) { rtcIntersect8(valid, top, &context, &packet); });
  }
  return closest_of<RTCRayHit16, 16>(
      rays, tree_->reach, hits, instances,
      [&](const int* valid, RTCRayHit16& packet) { rtcIntersect16(valid, top, &context, &packet); });
}

std::uint32_t RayScene::occluded(std::span<const Ray> rays) const {
  assert(rays.size() <= batch_size);
  if (rays.size() <= 1) return !rays.empty() && occluded(rays[0]) ? 1 : 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCScene top = tree_->top.get();
  if (rays.size() <= 8) {
    return occluded_of<RTCRay8, 8>(rays, tree_->reach, [&](const int* valid, RTCRay8& packet) {
      rtcOccluded8(valid, top, &context, &packet);
    });
  }
  return occluded_of<RTCRay16, 16>(rays, tree_->reach, [&](const int* valid, RTCRay16& packet) {
    rtcOccluded16(valid, top, &context, &packet);
  });
}

}  // namespace welkin
