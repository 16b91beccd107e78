#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <welkin/pathtrace/camera_ray.h>
#include <welkin/pathtrace/render_scene.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/shapes.h>
#include <welkin/sphere/equirect.h>

// What the path tracer says of the points at the centres of pixels, for the renderer, which draws those.

namespace welkin::oracle {

/// The surface at the centre of pixel (x, y) as the path tracer shades it; nothing where the ray meets none.
inline std::unique_ptr<ShadingPoint> point_at_pixel(const RenderScene& scene, const Camera& camera,
                                                    PictureSize size, int x, int y) {
  const RenderScene::Tables& tables = scene.tables();
  const Ray ray = CameraRays(camera, size).ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const auto hit = tables.rays.closest(ray);
  if (!hit) return nullptr;
  auto point = std::make_unique<ShadingPoint>();
  point->surface = surface_at(tables.rays, *hit, ray);
  prepare_shading(tables.scene, tables.materials, ray.direction, *point);
  return point;
}

/// BRDF times radiance over the hemisphere, in double: `parts` x `parts` points in each texel of an equirectangular map, by
/// solid angle. Right for lobes that are wide against the parts.
inline std::array<double, 3> reflected_by_sums(const ShadingPoint& point, const Image& map, int parts) {
  std::array<double, 3> sum{};
  const double high = map.height * parts, wide = map.width * parts;
  for (int row = 0; row < map.height * parts; ++row) {
    const double steradians = equirect_texel_solid_angle(map.width * parts, map.height * parts, row);
    for (int column = 0; column < map.width * parts; ++column) {
      const float* radiance = map.at(column / parts, row / parts);
      if (radiance[0] == 0 && radiance[1] == 0 && radiance[2] == 0) continue;
      const Vec3 d = equirect_direction({(column + 0.5) / wide, (row + 0.5) / high});
      const Vec3f light =
          point.frame.to_local({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
      const Rgb value = evaluate(*point.scatter, light, point.view);
      sum[0] += steradians * double{value.r} * radiance[0];
      sum[1] += steradians * double{value.g} * radiance[1];
      sum[2] += steradians * double{value.b} * radiance[2];
    }
  }
  return sum;
}

/// Small maps for the other techniques, so that a test takes no time with them.
inline std::shared_ptr<const EnvironmentData> small_environment(Image radiance) {
  IblOptions options;
  options.size = 16;
  options.irradiance_size = 8;
  options.dfg_size = 32;
  return make_environment_data(std::move(radiance), options);
}

/// A unit sphere of one material that fills the picture's middle: a mesh of few triangles with smooth normals.
inline Scene one_sphere(const Material& material) {
  Scene scene;
  scene.source = "one sphere";
  scene.materials = {material};
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= 16; ++i) {
    const float angle = std::numbers::pi_v<float> * (static_cast<float>(i) / 16 - 0.5f);
    const Vec2f point{i == 0 || i == 16 ? 0 : std::cos(angle), std::sin(angle)};
    outline.push_back({point, point});
  }
  scene.meshes = {make_lathe(outline, 32)};
  scene.instances = {{0, {}}};
  Camera camera;
  camera.to_world = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 4}};
  camera.vertical_field_radians = 0.5f;
  scene.cameras = {camera};
  return scene;
}

}  // namespace welkin::oracle
