#pragma once
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <welkin/envmap/reflection/truth.h>
#include <welkin/realtime/renderer.h>

// One sphere, drawn by a technique and integrated by brute force, pixel by pixel.

namespace welkin {

/// Where the camera of a sphere's picture stands, and how large the picture is.
struct SphereView {
  Vec3f towards{0, 0, 1};  ///< from the sphere to the camera
  int size = 48;           ///< pixels along an edge; the sphere fills 1 / 1.1 of it
};

/// A scene of one sphere of radius 1 about the origin, and its camera (orthographic).
inline Scene sphere_scene(const Material& material, const SphereView& view) {
  Scene scene;
  scene.source = "a sphere";
  scene.materials = {material};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  Camera camera;
  const Vec3f z = normalized(view.towards);
  const Vec3f x = normalized(std::abs(z.y) < 0.9f ? cross(Vec3f{0, 1, 0}, z) : cross(Vec3f{1, 0, 0}, z));
  camera.to_world = {x, cross(z, x), z, 5.0f * z};
  camera.orthographic_height = 2.2f;
  scene.cameras = {camera};
  return scene;
}

/// Draws pictures of one sphere by one technique, in floats, without the background. Needs a context.
class SpherePainter {
 public:
  explicit SpherePainter(const char* technique) : renderer_({TexelFormat::rgba32f, TexelFormat::rgba16f}) {
    renderer_.show_background = false;
    const TechniqueChoice choice = parse_technique(technique);
    renderer_.set_technique(*choice.technique, choice.values);
  }

  Image draw(const Material& material, const std::shared_ptr<const EnvironmentData>& light,
             const SphereView& view = {}) {
    const Scene scene = sphere_scene(material, view);
    renderer_.set_camera(scene.cameras[0]);
    renderer_.set_scene(scene);
    if (light != light_) renderer_.set_environment(light);
    light_ = light;
    renderer_.resize(view.size, view.size);
    renderer_.draw();
    return renderer_.read_picture();
  }

 private:
  Renderer renderer_;
  std::shared_ptr<const EnvironmentData> light_;
};

inline Image draw_sphere(const char* technique, const Material& material,
                         const std::shared_ptr<const EnvironmentData>& light, const SphereView& view = {}) {
  return SpherePainter(technique).draw(material, light, view);
}

/// A pixel of the sphere with what is seen there.
struct SpherePixel {
  int x = 0, y = 0;
  ReflectionQuery query;
};

/// Every `step`-th pixel in both directions whose cosine of the view is above `smallest_cos_view`.
inline std::vector<SpherePixel> sphere_pixels(const SphereView& view, int step, double smallest_cos_view) {
  const Camera camera = sphere_scene({}, view).cameras[0];
  const auto wide = [](Vec3f v) { return Vec3{v.x, v.y, v.z}; };
  const Vec3 right = wide(camera.to_world.x), up = wide(camera.to_world.y), back = wide(camera.to_world.z);
  std::vector<SpherePixel> pixels;
  for (int y = step / 2; y < view.size; y += step) {
    for (int x = step / 2; x < view.size; x += step) {
      const double a = 2.2 * ((x + 0.5) / view.size - 0.5), b = 2.2 * (0.5 - (y + 0.5) / view.size);
      const double cos_view = std::sqrt(std::max(0.0, 1 - a * a - b * b));
      if (cos_view < smallest_cos_view) continue;
      pixels.push_back({x, y, {normalized(a * right + b * up + cos_view * back), back}});
    }
  }
  return pixels;
}

/// Brute force for those pixels: [pixel * 3 + channel].
inline std::vector<double> sphere_truth(const Image& radiance, const IsotropicBrdf& brdf,
                                        std::span<const SpherePixel> pixels) {
  std::vector<ReflectionQuery> queries;
  for (const SpherePixel& pixel : pixels) queries.push_back(pixel.query);
  return reflect_brute_force(radiance, brdf, queries);
}

/// Over the pixels and channels: mean |difference| over mean truth, and the largest over mean truth.
struct SphereError {
  double mean = 0, largest = 0;
};

inline SphereError sphere_error(const Image& picture, std::span<const SpherePixel> pixels,
                                std::span<const double> truth) {
  double total = 0;
  SphereError error;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = std::abs(picture.at(pixels[i].x, pixels[i].y)[c] - truth[3 * i + c]);
      total += truth[3 * i + c];
      error.mean += off;
      error.largest = std::max(error.largest, off);
    }
  }
  error.mean /= total;
  error.largest *= static_cast<double>(truth.size()) / total;
  return error;
}

/// A small environment: a gradient, some texels of random strength, one lamp of `lamp` times the mean in one texel.
inline Image small_environment(unsigned seed, float lamp = 20) {
  Image map(32, 16);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      seed = seed * 1664525u + 1013904223u;
      const float random = static_cast<float>(seed >> 8) / 16777216.0f;
      const float sky = 1 - static_cast<float>(y) / 16;
      float* texel = map.at(x, y);
      texel[0] = 0.2f + 0.5f * random;
      texel[1] = 0.2f + 0.3f * random + 0.2f * sky;
      texel[2] = 0.1f + 0.8f * sky;
    }
  }
  float* texel = map.at(static_cast<int>(seed >> 16) % 32, 3 + static_cast<int>(seed >> 24) % 6);
  texel[0] += lamp, texel[1] += 0.9f * lamp, texel[2] += 0.7f * lamp;
  return map;
}

/// The maps of an equirectangular image, small.
inline std::shared_ptr<const EnvironmentData> small_maps(Image radiance, int size = 64) {
  IblOptions options;
  options.size = size;
  options.irradiance_size = 32;
  return make_environment_data(std::move(radiance), options);
}

inline Image constant_environment(float r, float g, float b) {
  Image map(32, 16);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3)
    map.pixels[i] = r, map.pixels[i + 1] = g, map.pixels[i + 2] = b;
  return map;
}

}  // namespace welkin
