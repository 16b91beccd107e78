// Rays a second of the integrators, shading and all, beside a bare Embree loop over the same rays in the same order, by the
// best of alternating runs: hills and spheres, a built-in scene, and the mesh that is named, on a plane.
// bench_rays [MESH]
#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <vector>

#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/render_sample.h>
#include <welkin/raytrace/flush_denormals.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/read_scene.h>
#include "bench/measure.h"

namespace {

using namespace welkin;

struct LoggedRay {
  Ray ray;
  bool shadow = false;
};

/// Traces rays in the scene and writes them down.
struct Recorder {
  const RayScene& scene;
  std::vector<LoggedRay>& log;

  std::uint32_t closest(std::span<const Ray> rays, Hit* hits, RayKind kind) {
    for (const Ray& ray : rays) log.push_back({ray, false});
    return scene.closest(rays, hits, kind);
  }
  std::uint32_t occluded(std::span<const Ray> rays) {
    for (const Ray& ray : rays) log.push_back({ray, true});
    return scene.occluded(rays);
  }
};

/// The least that Embree needs: one tree, made as RayScene makes its own.
class BareEmbree {
 public:
  explicit BareEmbree(const Scene& scene) : device_(rtcNewDevice(nullptr)), top_(rtcNewScene(device_)) {
    rtcSetSceneFlags(top_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(top_, RTC_BUILD_QUALITY_HIGH);
    for (const Instance& instance : scene.instances) {
      add_mesh(scene.meshes[instance.mesh], instance.to_world);
    }
    if (!scene.spheres.empty()) add_spheres(scene.spheres);
    rtcCommitScene(top_);
  }
  ~BareEmbree() {
    rtcReleaseScene(top_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  /// How many of the rays met something.
  std::size_t trace(const std::vector<LoggedRay>& rays) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    std::size_t met = 0;
    for (const LoggedRay& logged : rays) {
      const Ray& r = logged.ray;
      RTCRayHit query;
      query.ray = {r.origin.x, r.origin.y, r.origin.z, r.near, r.direction.x, r.direction.y, r.direction.z, 0,
                   r.far,      ~0u,        0,          0};
      if (logged.shadow) {
        rtcOccluded1(top_, &context, &query.ray);
        met += query.ray.tfar < 0;
      } else {
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(top_, &context, &query);
        met += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      }
    }
    return met;
  }

 private:
  void add_mesh(const Mesh& mesh, const Affine& to_world) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.positions.size()));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) points[i] = to_world.point(mesh.positions[i]);
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof mesh.triangles[0], mesh.triangles.size());
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles[0]);
    attach(geometry);
  }
  void add_spheres(const std::vector<Sphere>& spheres) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres.size()));
    for (const Sphere& s : spheres) {
      for (const float v : {s.centre.x, s.centre.y, s.centre.z, s.radius}) *points++ = v;
    }
    attach(geometry);
  }
  void attach(RTCGeometry geometry) {
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(top_, geometry);
    rtcReleaseGeometry(geometry);
  }

  RTCDevice device_;
  RTCScene top_;
};

/// Seconds of the wall's clock and of all cores together: the second hardly minds what else the machine does.
struct Clocks {
  double wall = 1e30, cores = 1e30;
};

template <class Task>
void time_into(Clocks& best, Task&& task) {
  const std::clock_t start = std::clock();
  const double wall = bench::seconds_of(task);
  best.wall = std::min(best.wall, wall);
  best.cores = std::min(best.cores, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
}

/// Hills of 2 n^2 triangles with smooth normals, 10 x 10 m, and five spheres of different gloss on them.
Scene hills(int n) {
  Scene scene;
  scene.source = "hills";
  Mesh mesh;
  const auto height = [](float x, float z) {
    return 0.25f * std::sin(2.1f * x) * std::cos(1.7f * z) +
           0.04f * std::sin(11 * x + 3 * z) * std::cos(9 * z);
  };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = 10 * (static_cast<float>(i) / static_cast<float>(n) - 0.5f);
      const float z = 10 * (static_cast<float>(j) / static_cast<float>(n) - 0.5f);
      const float h = 1e-3f, dx = (height(x + h, z) - height(x - h, z)) / (2 * h);
      const float dz = (height(x, z + h) - height(x, z - h)) / (2 * h);
      mesh.positions.push_back({x, height(x, z), z});
      mesh.normals.push_back(normalized(Vec3f{-dx, 1, -dz}));
    }
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  }
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({});
  Material ground;
  ground.model = MaterialModel::lambert;
  ground.base_color = {0.6f, 0.5f, 0.4f};
  scene.materials.push_back(ground);
  for (int i = 0; i < 5; ++i) {
    Material gloss;
    gloss.base_color = {0.8f, 0.7f, 0.5f};
    gloss.metallic = i % 2 == 0 ? 1.0f : 0.0f;
    gloss.perceptual_roughness = 0.2f + 0.15f * static_cast<float>(i);
    scene.materials.push_back(gloss);
    scene.spheres.push_back({{1.6f * static_cast<float>(i) - 3.2f, 0.8f, 0}, 0.7f, i + 1});
  }
  return scene;
}

/// The scene of the file on a square plane, 6 of its diagonals wide.
Scene on_plane(const char* file) {
  Scene scene = read_scene(file);
  scene.cameras.clear();
  const Bounds bounds = *scene_bounds(scene);
  const Vec3f middle = 0.5f * (bounds.low + bounds.high);
  const float half = 3 * length(bounds.high - bounds.low), y = bounds.low.y;
  Mesh plane;
  plane.material = static_cast<int>(scene.materials.size());
  for (const Vec2f corner : {Vec2f{-1, -1}, Vec2f{-1, 1}, Vec2f{1, 1}, Vec2f{1, -1}}) {
    plane.positions.push_back({middle.x + half * corner.x, y, middle.z + half * corner.y});
  }
  plane.triangles = {{0, 1, 2}, {0, 2, 3}};
  Material gray;
  gray.model = MaterialModel::lambert;
  gray.base_color = {0.5f, 0.5f, 0.5f};
  scene.materials.push_back(gray);
  scene.instances.emplace_back();
  scene.instances.back().mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back(std::move(plane));
  return scene;
}

/// A sky that brightens towards a small sun.
EnvironmentSampler sky() {
  Image map(512, 256);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const float up = 1 - static_cast<float>(y) / 128,
                  sun = std::hypot(static_cast<float>(x - 180), static_cast<float>(y - 60));
      float* p = map.at(x, y);
      p[0] = up > 0 ? 0.4f + 0.3f * (1 - up) : 0.2f;
      p[1] = up > 0 ? 0.5f + 0.3f * (1 - up) : 0.18f;
      p[2] = up > 0 ? 0.9f : 0.15f;
      if (sun < 3) p[0] = p[1] = p[2] = 2000;
    }
  }
  return EnvironmentSampler(std::move(map));
}

constexpr PictureSize size{96, 64};
constexpr int rows_per_chunk = 2;
constexpr std::size_t chunks = size.height / rows_per_chunk;

template <class Pixel>
void for_all_pixels(std::size_t chunk, Pixel&& pixel) {
  for (int y = static_cast<int>(chunk) * rows_per_chunk; y < static_cast<int>(chunk + 1) * rows_per_chunk;
       ++y) {
    for (int x = 0; x < size.width; ++x) pixel(x, y);
  }
}

struct Work {
  const char* name;
  IntegratorOptions options;
  std::uint32_t samples;
  double goal;  ///< least share of the bare loop's rays a second
};

void compare(bench::Report& report, const RenderScene& render, const BareEmbree& bare, const Camera& camera,
             const Work& work) {
  std::vector<SampleNumber> numbers(work.samples);
  for (std::uint32_t i = 0; i < work.samples; ++i) numbers[i].index = i;
  std::vector<std::vector<LoggedRay>> logs(chunks);
  parallel_for(chunks, 1, [&](std::size_t begin, std::size_t) {
    Recorder recorder{render.tables().rays, logs[begin]};
    std::vector<PixelSample> samples(work.samples);
    for_all_pixels(begin, [&](int x, int y) {
      render_samples_with(recorder, render, camera, size, x, y, numbers, work.options, samples);
    });
  });
  std::size_t rays = 0;
  for (const auto& log : logs) rays += log.size();
  std::vector<double> sums(chunks), met(chunks);
  Clocks own, other;
  for (int run = 0; run < 24; ++run) {
    time_into(own, [&] {
      parallel_for(chunks, 1, [&](std::size_t begin, std::size_t) {
        const FlushDenormals flush;
        double sum = 0;
        std::vector<PixelSample> samples(work.samples);
        for_all_pixels(begin, [&](int x, int y) {
          render_samples(render, camera, size, x, y, numbers, work.options, samples);
          for (const PixelSample& s : samples) sum += luminance(s.radiance);
        });
        sums[begin] = sum;
      });
    });
    time_into(other, [&] {
      parallel_for(chunks, 1, [&](std::size_t begin, std::size_t) {
        const FlushDenormals flush;
        met[begin] = static_cast<double>(bare.trace(logs[begin]));
      });
    });
  }
  const double share = other.wall / own.wall;
  double mean = 0;
  for (const double s : sums) mean += s / (size.width * size.height * static_cast<double>(work.samples));
  const double count = static_cast<double>(rays);
  report.note(fmt::format(
      "  {:<26} {:>6.2f} M rays/s, bare Embree {:>6.2f}: share {:.2f}, by core time {:.2f} (goal {:.2f}) {}; "
      "{:.1f} M rays, mean {:.4f}",
      work.name, count / own.wall / 1e6, count / other.wall / 1e6, share, other.cores / own.cores, work.goal,
      share >= work.goal ? "reached" : "MISSED", count / 1e6, mean));
}

void one_scene(bench::Report& report, const Scene& scene, const Camera& camera,
               const EnvironmentSampler& environment) {
  const RenderScene render(scene, &environment);
  const BareEmbree bare(scene);
  std::size_t triangles = 0;
  for (const Instance& instance : scene.instances) triangles += scene.meshes[instance.mesh].triangles.size();
  report.note(fmt::format("{}: {} triangles, {} spheres, {} threads", scene.source, triangles,
                          scene.spheres.size(), thread_count()));
  IntegratorOptions occlusion;
  occlusion.integrator = Integrator::ambient_occlusion;
  occlusion.occlusion_rays = 16;
  compare(report, render, bare, camera, {"ambient occlusion, 16 rays", occlusion, 4, 0.8});
  IntegratorOptions direct;
  direct.integrator = Integrator::direct;
  compare(report, render, bare, camera, {"direct, mis", direct, 16, 0.6});
  IntegratorOptions path;
  compare(report, render, bare, camera, {"path, mis", path, 16, 0.6});
}

void one_scene(bench::Report& report, const Scene& scene, const EnvironmentSampler& environment) {
  one_scene(report, scene,
            scene.cameras.empty() ? default_camera(*scene_bounds(scene), 1.5) : scene.cameras[0],
            environment);
}

}  // namespace

int main(int count, char** arguments) {
  bench::Report report;
  const EnvironmentSampler environment = sky();
  one_scene(report, hills(320), environment);
  one_scene(report, make_built_in_scene("shader-ball"), environment);
  if (count > 1) {
    const Scene scene = on_plane(arguments[1]);
    const Bounds bounds = *scene_bounds(read_scene(arguments[1]));
    one_scene(report, scene, default_camera(bounds, 1.5), environment);
  }
  return report.exit_code();
}
