#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <welkin/sphere/equirect.h>
#include "tests/pathtrace/estimates.h"

namespace welkin {
namespace {

using namespace oracle;

const LightSampling all_samplings[] = {LightSampling::bsdf, LightSampling::light, LightSampling::mis,
                                       LightSampling::product};

Material lambert(float albedo) {
  Material m;
  m.model = MaterialModel::lambert;
  m.base_color = {albedo, albedo, albedo};
  return m;
}

/// A rectangle with corners centre +- a +- b, its front along a x b.
Mesh rectangle(Vec3f centre, Vec3f a, Vec3f b, int material) {
  Mesh mesh;
  mesh.positions = {centre - a - b, centre + a - b, centre + a + b, centre - a + b};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = material;
  return mesh;
}

void add(Scene& scene, Mesh mesh) {
  scene.instances.push_back({static_cast<int>(scene.meshes.size()), {}});
  scene.meshes.push_back(std::move(mesh));
}

/// The plane y = 0, facing up, of albedo 1: its radiance is the irradiance over pi.
Scene white_floor(float half_width = 50) {
  Scene scene;
  scene.source = "floor";
  scene.materials.push_back(lambert(1));
  add(scene, rectangle({}, {0, 0, half_width}, {half_width, 0, 0}, 0));
  return scene;
}

/// Sees nothing but the surroundings (about 1 mm) of `at`.
Camera looking_at(Vec3f at, Vec3f eye) {
  Camera camera;
  camera.to_world = look_at(eye, at, {0, 1, 0});
  camera.vertical_field_radians = 1e-3f / length(eye - at);
  return camera;
}

constexpr PictureSize few_pixels{8, 8};

IntegratorOptions direct(LightSampling sampling) {
  IntegratorOptions options;
  options.integrator = Integrator::direct;
  options.sampling = sampling;
  return options;
}

/// |estimate - truth| within 5 standard errors (6e-7 by chance) or 1e-5 of the truth (single precision).
void expect_estimates(const Estimate& e, double truth, double most_error = 0.02) {
  EXPECT_NEAR(e.mean, truth, std::max(5 * e.standard_error, 1e-5 * truth));
  EXPECT_LT(e.standard_error, most_error * truth);
}

// Inside a closed surface that emits E and reflects rho of what comes, radiance is E (1 + rho + rho^2 + ...) everywhere.
TEST(ClosedForms, ConcaveFurnace) {
  for (const bool sphere : {true, false}) {
    Scene scene;
    scene.source = "inside";
    scene.materials.push_back(lambert(0.6f));
    scene.materials[0].emission = {0.5f, 0.5f, 0.5f};
    scene.materials[0].double_sided = true;
    if (sphere) {
      scene.spheres.push_back({{0, 0, 0}, 2, 0});
    } else {
      for (const float side : {-1.0f, 1.0f}) {
        add(scene, rectangle({side, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0));
        add(scene, rectangle({0, side, 0}, {1, 0, 0}, {0, 0, 1}, 0));
        add(scene, rectangle({0, 0, side}, {1, 0, 0}, {0, 1, 0}, 0));
      }
    }
    const RenderScene render(scene, nullptr);
    Camera camera;
    camera.to_world.origin = {0.1f, 0.2f, 0.3f};
    for (const LightSampling sampling : all_samplings) {
      SCOPED_TRACE(testing::Message() << "sphere " << sphere << " sampling " << static_cast<int>(sampling));
      IntegratorOptions options;
      options.sampling = sampling;
      options.max_bounces = 1000;
      expect_estimates(picture_luminance(render, camera, few_pixels, 256, options), 0.5 / (1 - 0.6), 0.02);
    }
  }
}

// Lambert 1760: E = L / 2 times the sum over the edges of (angle between the corners as seen from the point) x (unit normal
// of the plane through point and edge, inwards) . normal.
double contour_irradiance(const Mesh& light, Vec3f point) {
  const double n[3] = {0, 1, 0};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3f a = normalized(light.positions[i] - point),
                b = normalized(light.positions[(i + 1) % 4] - point);
    const Vec3f across = cross(a, b);
    const double angle = std::atan2(length(across), dot(a, b));
    sum += angle * (n[1] * across.y) / length(across);
  }
  return std::abs(sum) / 2;
}

TEST(ClosedForms, RectangleLightAgainstLambertsContour) {
  Scene scene = white_floor();
  Material glow = lambert(0);
  glow.emission = {3, 3, 3};
  scene.materials.push_back(glow);
  const Mesh light = rectangle({0.5f, 1.5f, -0.3f}, {0.8f, 0.1f, 0}, {0, 0.2f, 0.6f}, 1);  // faces down
  add(scene, light);
  const RenderScene render(scene, nullptr);
  for (const Vec3f at : {Vec3f{0, 0, 0}, Vec3f{0.5f, 0, -0.3f}, Vec3f{-2, 0, 1}}) {
    for (const LightSampling sampling : all_samplings) {
      SCOPED_TRACE(testing::Message() << "x " << at.x << " sampling " << static_cast<int>(sampling));
      const Camera camera = looking_at(at, at + Vec3f{-4, 3, 4});
      expect_estimates(picture_luminance(render, camera, few_pixels, 1024, direct(sampling)),
                       3 * contour_irradiance(light, at) / M_PI);
    }
  }
}

// The cosine-weighted share of the hemisphere that a sphere of radius R at distance D covers, all of it above the horizon,
// is (R / D)^2 cos(angle to its centre) (as the view factor of a sphere, Howell); one that rests on the plane at distance d
// from the point covers R^3 / (d^2 + R^2)^(3/2).
TEST(ClosedForms, OcclusionOfAPlaneByASphere) {
  Scene scene = white_floor();
  scene.spheres.push_back({{0, 0.7f, 0}, 0.7f, 0});
  const RenderScene render(scene, nullptr);
  IntegratorOptions options;
  options.integrator = Integrator::ambient_occlusion;
  options.occlusion_rays = 4;
  for (const float d : {0.8f, 1.0f, 2.0f, 5.0f}) {
    const Vec3f at{d, 0, 0};
    const double covered = std::pow(0.7, 3) / std::pow(d * d + 0.49, 1.5);
    expect_estimates(
        picture_luminance(render, looking_at(at, at + Vec3f{3, 4, 1}), few_pixels, 1024, options),
        1 - covered);
  }
  options.occlusion_distance = 0.05f;  // nothing is that near
  EXPECT_EQ(picture_luminance(render, looking_at({1, 0, 0}, {4, 4, 1}), few_pixels, 16, options).mean, 1);
}

// The same share is missing from the light of a constant environment.
TEST(ClosedForms, ShadowOfASphereUnderAConstantSky) {
  Scene scene = white_floor();
  Material black = lambert(0);
  scene.materials.push_back(black);
  scene.spheres.push_back({{0, 0.7f, 0}, 0.7f, 1});
  const EnvironmentSampler sky = constant_environment({2, 2, 2});
  const RenderScene render(scene, &sky);
  for (const LightSampling sampling : all_samplings) {
    const Camera camera = looking_at({1, 0, 0}, {4, 4, 1});
    expect_estimates(picture_luminance(render, camera, few_pixels, 1024, direct(sampling)),
                     2 * (1 - std::pow(0.7, 3) / std::pow(1.49, 1.5)));
  }
}

TEST(ClosedForms, OneTexelIsADirectionalLight) {
  Image map(256, 128);
  constexpr int x = 40, y = 30;
  for (int c = 0; c < 3; ++c) map.at(x, y)[c] = 5000;
  const double irradiance = 5000 * equirect_texel_solid_angle(256, 128, y);
  const double theta = M_PI * (y + 0.5) / 128, phi = 2 * M_PI * ((x + 0.5) / 256 - 0.5);
  const double truth = irradiance * std::cos(theta) / M_PI;  // on the floor
  const EnvironmentSampler sky(std::move(map));
  const Scene floor = white_floor();
  Scene lamp = floor;
  PunctualLight sun;
  sun.direction = {static_cast<float>(-std::sin(theta) * std::cos(phi)), static_cast<float>(-std::cos(theta)),
                   static_cast<float>(-std::sin(theta) * std::sin(phi))};
  sun.intensity = static_cast<float>(irradiance) * Rgb{1, 1, 1};
  lamp.lights.push_back(sun);
  const RenderScene with_texel(floor, &sky), with_sun(lamp, nullptr);
  const Camera camera = looking_at({}, {1, 2, 3});
  // The texel is 0.025 rad wide: its mean cosine differs from the middle's by 0.025^2 / 24 and less.
  for (const LightSampling sampling : {LightSampling::light, LightSampling::mis}) {
    EXPECT_NEAR(picture_luminance(with_texel, camera, few_pixels, 256, direct(sampling)).mean, truth,
                1e-4 * truth);
  }
  for (const LightSampling sampling : all_samplings) {
    EXPECT_NEAR(picture_luminance(with_sun, camera, few_pixels, 16, direct(sampling)).mean, truth,
                1e-5 * truth);
  }
}

TEST(ClosedForms, PointAndSpotLightsFallWithTheSquareOfTheDistance) {
  for (const float height : {1.0f, 2.0f, 8.0f}) {
    Scene scene = white_floor();
    PunctualLight light;
    light.kind = PunctualLight::Kind::point;
    light.position = {1, height, 0};
    light.intensity = {7, 7, 7};
    scene.lights.push_back(light);
    const RenderScene render(scene, nullptr);
    const double squared = 1 + height * height, truth = 7 / M_PI * height / std::pow(squared, 1.5);
    const Camera camera = looking_at({}, {-1, 2, 3});
    for (const LightSampling sampling : all_samplings) {
      // The millimetre that the camera sees changes the distance by 5e-4 of itself at most; its mean far less.
      EXPECT_NEAR(picture_luminance(render, camera, few_pixels, 64, direct(sampling)).mean, truth,
                  1e-4 * truth);
    }
    scene.lights[0].kind = PunctualLight::Kind::spot;
    scene.lights[0].direction = normalized(Vec3f{-1, -height, 0});
    scene.lights[0].outer_cone_radians = 0.2f;
    const RenderScene in_beam(scene, nullptr);
    EXPECT_NEAR(picture_luminance(in_beam, camera, few_pixels, 64, direct(LightSampling::mis)).mean, truth,
                1e-4 * truth);
    scene.lights[0].direction = {0.5f, -0.8660254f, 0};
    const RenderScene beside(scene, nullptr);
    EXPECT_EQ(picture_luminance(beside, camera, few_pixels, 16, direct(LightSampling::mis)).mean, 0);
  }
}

// A sphere of radiance L at distance D: E = pi L (R / D)^2 cos.
TEST(ClosedForms, EmissiveSphere) {
  Scene scene = white_floor();
  Material glow = lambert(0);
  glow.emission = {5, 5, 5};
  scene.materials.push_back(glow);
  scene.spheres.push_back({{2, 1.5f, 0}, 0.5f, 1});
  const RenderScene render(scene, nullptr);
  const double squared = 4 + 2.25, truth = 5 * 0.25 / squared * 1.5 / std::sqrt(squared);
  for (const LightSampling sampling : all_samplings) {
    expect_estimates(
        picture_luminance(render, looking_at({}, {-1, 2, 3}), few_pixels, 1024, direct(sampling)), truth);
  }
}

// No light gets into a closed box, whatever is outside: exactly black.
TEST(ClosedForms, AClosedBoxIsBlackInside) {
  for (const Vec3f centre : {Vec3f{0, 0, 0}, Vec3f{1000, -300, 70}}) {
    Scene scene;
    scene.source = "box";
    scene.materials.push_back(lambert(0.9f));
    for (const float side : {-1.0f, 1.0f}) {
      add(scene, rectangle(centre + Vec3f{side, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0));
      add(scene, rectangle(centre + Vec3f{0, side, 0}, {1, 0, 0}, {0, 0, 1}, 0));
      add(scene, rectangle(centre + Vec3f{0, 0, side}, {1, 0, 0}, {0, 1, 0}, 0));
    }
    const EnvironmentSampler sky = constant_environment({1e6f, 1e6f, 1e6f});
    const RenderScene render(scene, &sky);
    Camera camera;
    camera.to_world.origin = centre + Vec3f{0.3f, 0.1f, 0.5f};
    camera.vertical_field_radians = 2;
    IntegratorOptions options;
    EXPECT_EQ(picture_luminance(render, camera, {24, 24}, 32, options).mean, 0);
  }
}

TEST(ClosedForms, LayersOfTheFirstSurface) {
  Scene scene = white_floor();
  scene.materials[0].base_color = {0.2f, 0.4f, 0.6f};
  const EnvironmentSampler sky = constant_environment({1, 1, 1});
  const RenderScene render(scene, &sky);
  Camera camera;
  camera.to_world = look_at({0, 3, 0}, {0, 0, -4}, {0, 1, 0});
  const PixelSample floor = render_sample(render, camera, {9, 9}, 4, 4, 0, {});
  EXPECT_FLOAT_EQ(floor.albedo.g, 0.4f);
  EXPECT_NEAR(floor.normal.y, 1, 1e-6);
  EXPECT_NEAR(floor.depth, 5, 0.5);  // along the axis; half a pixel is 0.4 m here
  EXPECT_EQ(floor.coverage, 1);
  camera.to_world = look_at({0, 3, 0}, {0, 5, -4}, {0, 1, 0});
  IntegratorOptions options;
  const PixelSample sky_pixel = render_sample(render, camera, {9, 9}, 4, 4, 0, options);
  EXPECT_FLOAT_EQ(sky_pixel.radiance.g, 1);
  EXPECT_EQ(sky_pixel.coverage, 0);
  EXPECT_EQ(sky_pixel.depth, 0);
  EXPECT_TRUE(is_black(sky_pixel.albedo));
  options.show_environment = false;
  EXPECT_TRUE(is_black(render_sample(render, camera, {9, 9}, 4, 4, 0, options).radiance));
}

}  // namespace
}  // namespace welkin
