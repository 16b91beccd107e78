#include <welkin/raytrace/ray_scene.h>

#include <embree3/rtcore.h>

#include <algorithm>
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

/// A number in [0, 1) that is the same for the same ray and primitive, and else as good as random.
float ray_hash(const RTCRay& ray, std::uint32_t object, std::uint32_t primitive) {
  std::uint32_t hash = mixed(object, primitive);
  for (const float value : {ray.org_x, ray.org_y, ray.org_z, ray.dir_x, ray.dir_y, ray.dir_z}) {
    hash = mixed(hash, bits_of(value));
  }
  hash ^= hash >> 13;
  return static_cast<float>(hash >> 8) * 0x1p-24f;
}

Vec2f interpolated(const std::vector<Vec2f>& values, const std::array<std::uint32_t, 3>& corners, float u,
                   float v) {
  if (values.empty()) return {};
  return (1 - u - v) * values[corners[0]] + u * values[corners[1]] + v * values[corners[2]];
}

/// Embree's filter for single rays: says that there is no hit where the material has a hole.
void pass_holes(const RTCFilterFunctionNArguments* arguments) {
  const CutOut& cut = *static_cast<const CutOut*>(arguments->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const Scene& scene = *cut.scene;
  Vec2f texcoords[2];
  int material_index = 0;
  if (cut.mesh != nullptr) {
    material_index = cut.mesh->material;
    const auto& corners = cut.mesh->triangles[hit.primID];
    for (int i = 0; i < 2; ++i) {
      texcoords[i] = interpolated(cut.mesh->texcoords[i], corners, hit.u, hit.v);
    }
  } else {
    const Sphere& sphere = scene.spheres[hit.primID];
    material_index = sphere.material;
    const Vec3f direction{ray.dir_x, ray.dir_y, ray.dir_z};
    const Vec3f position = Vec3f{ray.org_x, ray.org_y, ray.org_z} + ray.tfar * direction;
    texcoords[0] = texcoords[1] = sphere_texcoord(normalized(position - sphere.centre));
  }
  const Material& material = scene.materials[material_index];
  if (material.alpha_mode == AlphaMode::opaque) return;
  const float coverage = coverage_at(scene, material, texcoords);
  const float needed = material.alpha_mode == AlphaMode::mask
                           ? material.alpha_cutoff
                           : ray_hash(ray, hit.geomID ^ hit.instID[0], hit.primID) + 1e-9f;
  if (coverage < needed) arguments->valid[0] = 0;
}

bool has_holes(const Scene& scene, int material) {
  return scene.materials[material].alpha_mode != AlphaMode::opaque;
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
  // What cannot be inverted has to be flattened (into nothing that is ever hit, or into a sheet).
  placed.in_world = in_world || !(std::abs(volume) > 1e-30f);
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

std::optional<Hit> RayScene::closest(const Ray& ray) const {
  RTCRayHit query;
  query.ray = {ray.origin.x,
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
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(tree_->top.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit{query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
  if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    hit.object = query.hit.instID[0];
  } else if (hit.object == tree_->placed.size()) {
    hit.object += hit.triangle;
    hit.triangle = 0;
  }
  return hit;
}

bool RayScene::occluded(const Ray& ray) const {
  RTCRay query{ray.origin.x,
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
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tree_->top.get(), &context, &query);
  return query.tfar < 0;
}

}  // namespace welkin
