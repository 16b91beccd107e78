#include <welkin/pathtrace/light_table.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <welkin/raytrace/texture_lookup.h>
#include <welkin/sampling/warp.h>

namespace welkin {
namespace {

constexpr std::uint32_t no_light = ~0u;

bool emits(const Material& material) { return !is_black(material.emission); }

/// Mean luminance of the emission of a triangle with these texture coordinates: 15 points of a grid, and a share of the
/// largest texel's, so that no lit triangle is believed dark.
double mean_emission(const Scene& scene, const Mesh& mesh, std::size_t triangle) {
  const Material& material = scene.materials[mesh.material];
  const double plain = luminance(material.emission);
  const TextureUse& use = material.emission_texture;
  if (use.texture < 0) return plain;
  constexpr int steps = 4;
  double sum = 0;
  int count = 0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const float u = static_cast<float>(i) / steps, v = static_cast<float>(j) / steps;
      Vec2f texcoords[2];
      for (int k = 0; k < 2; ++k) {
        if (mesh.texcoords[k].empty()) continue;
        const auto& c = mesh.triangles[triangle];
        texcoords[k] =
            (1 - u - v) * mesh.texcoords[k][c[0]] + u * mesh.texcoords[k][c[1]] + v * mesh.texcoords[k][c[2]];
      }
      const Texel texel = look_up(scene, use, texcoords);
      sum += luminance(material.emission * Rgb{texel[0], texel[1], texel[2]});
      ++count;
    }
  }
  return sum / count + 0.05 * plain;
}

/// Area and normal, in double: squares of the cross product of edges of 1e-10 metres, or of 1e10, are beyond floats.
void set_plane(TriangleLight& light, bool mirrored) {
  const Vec3f a = light.edge_u, b = light.edge_v;
  const double x = double{a.y} * b.z - double{a.z} * b.y, y = double{a.z} * b.x - double{a.x} * b.z,
               z = double{a.x} * b.y - double{a.y} * b.x;
  const double doubled = std::sqrt(x * x + y * y + z * z), scale = (mirrored ? -1 : 1) / doubled;
  light.area = static_cast<float>(doubled / 2);
  if (!(light.area > 0)) return;
  light.normal = {static_cast<float>(scale * x), static_cast<float>(scale * y),
                  static_cast<float>(scale * z)};
}

TriangleLight triangle_light(const PlacedMesh& placed, std::uint32_t object, std::uint32_t triangle) {
  TriangleLight light;
  const auto& corners = placed.mesh->triangles[triangle];
  Vec3f p[3];
  float largest = placed.in_world ? 0 : placed.origin_size;
  for (int i = 0; i < 3; ++i) {
    p[i] = placed.positions[corners[i]];
    if (!placed.in_world) p[i] = placed.to_world.point(p[i]);
    largest = std::max({largest, std::abs(p[i].x), std::abs(p[i].y), std::abs(p[i].z)});
  }
  light.corner = p[0];
  light.edge_u = p[1] - p[0];
  light.edge_v = p[2] - p[0];
  set_plane(light, placed.mirrored);
  light.offset = (64 * 0x1p-24f + 2 * placed.transform_error) * largest;
  light.material = placed.mesh->material;
  light.object = object;
  light.triangle = triangle;
  return light;
}

/// Radiant power of a punctual light, W, by luminance; a directional one through a disc of this area.
double punctual_power(const PunctualLight& light, double disc_area) {
  const double intensity = luminance(light.intensity);
  switch (light.kind) {
    case PunctualLight::Kind::directional: return intensity * disc_area;
    case PunctualLight::Kind::point: return 4 * M_PI * intensity;
    default: return 2 * M_PI * (1 - std::cos(light.outer_cone_radians)) * intensity;
  }
}

/// pi r^2 of the sphere about the scene's bounds.
double bounding_disc(const Scene& scene) {
  const std::optional<Bounds> bounds = scene_bounds(scene);
  if (!bounds) return 1;
  const Vec3f diagonal = bounds->high - bounds->low;
  return M_PI / 4 * dot(diagonal, diagonal);
}

/// What is left of a spot light at this angle: KHR_lights_punctual's smooth edge.
float spot_share(const PunctualLight& light, Vec3f from_light) {
  const float outer = std::cos(light.outer_cone_radians);
  const float inner = std::max(std::cos(light.inner_cone_radians), outer + 1e-4f);
  const float t = std::clamp((dot(from_light, light.direction) - outer) / (inner - outer), 0.0f, 1.0f);
  return t * t;
}

/// 1 - cos of the cone in which a sphere is seen from this squared distance to its centre, outside it.
float one_minus_cosine(float radius, float squared) {
  const float sine_squared = std::min(radius * radius / squared, 1.0f);
  return sine_squared / (1 + std::sqrt(1 - sine_squared));
}

/// Whether the light is seen from inside. Points of the sphere itself are off it by their rounding, and count as inside:
/// those that look outwards see nothing of it either way.
bool is_inside(Vec3f from, const SphereLight& light) {
  const Vec3f way = light.centre - from;
  const float error = 24 * 0x1p-24f * (light.radius + length(light.centre));
  const float reach = light.radius + error;
  return dot(way, way) <= reach * reach;
}

void set_sky(const EnvironmentSample& sky, LightSample& sample) {
  sample.direction = sky.direction;
  sample.radiance = sky.radiance;
  sample.pdf = sky.pdf;
}

}  // namespace

LightTable::LightTable(const RayScene& rays, const EnvironmentSampler* environment)
    : scene_(&rays.scene()), environment_(environment) {
  const double luminance_of_sky = environment == nullptr ? 0 : environment->mean_luminance();
  if (!(luminance_of_sky > 0)) environment_ = nullptr;
  first_light_.assign(scene_->instances.size() + scene_->spheres.size(), no_light);
  add_spheres();
  add_triangles(rays);
  set_shares(luminance_of_sky);
}

void LightTable::add_spheres() {
  for (std::size_t i = 0; i < scene_->spheres.size(); ++i) {
    const Sphere& sphere = scene_->spheres[i];
    if (!emits(scene_->materials[sphere.material])) continue;
    first_light_[scene_->instances.size() + i] = static_cast<std::uint32_t>(spheres_.size());
    spheres_.push_back({sphere.centre, sphere.radius, sphere.material});
  }
}

void LightTable::add_triangles(const RayScene& rays) {
  for (std::size_t i = 0; i < rays.placed().size(); ++i) {
    const PlacedMesh& placed = rays.placed()[i];
    if (!emits(scene_->materials[placed.mesh->material])) continue;
    first_light_[i] = static_cast<std::uint32_t>(triangles_.size());
    for (std::size_t t = 0; t < placed.mesh->triangles.size(); ++t) {
      triangles_.push_back(
          triangle_light(placed, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(t)));
    }
  }
}

void LightTable::set_shares(double environment_luminance) {
  const double disc = bounding_disc(*scene_);
  std::vector<double> power;
  const auto group = [&](std::size_t begin) {
    double sum = 0;
    for (std::size_t i = begin; i < power.size(); ++i) sum += power[i];
    return sum;
  };
  for (const PunctualLight& light : scene_->lights) power.push_back(punctual_power(light, disc));
  const double punctual = group(0);
  const double sky = 4 * M_PI * environment_luminance * disc;
  power.push_back(sky);
  first_sphere_ = power.size();
  for (const SphereLight& sphere : spheres_) {
    const double area = 4 * M_PI * sphere.radius * sphere.radius;
    power.push_back(M_PI * luminance(scene_->materials[sphere.material].emission) * area);
  }
  for (const TriangleLight& light : triangles_) {
    const Mesh& mesh = scene_->meshes[scene_->instances[light.object].mesh];
    const double sides = scene_->materials[light.material].double_sided ? 2 : 1;
    power.push_back(sides * M_PI * light.area * mean_emission(*scene_, mesh, light.triangle));
  }
  const double surfaces = group(first_sphere_);
  const double all = punctual + sky + surfaces;
  if (!(all > 0)) return;
  const double groups = (punctual > 0) + (sky > 0) + (surfaces > 0);
  const auto factor = [&](double of) { return of > 0 ? 0.75 / all + 0.25 / (groups * of) : 0; };
  for (std::size_t i = 0; i < power.size(); ++i) {
    const bool is_punctual = i < scene_->lights.size(), is_sky = i == scene_->lights.size();
    power[i] *= factor(is_punctual ? punctual : is_sky ? sky : surfaces);
  }
  choice_ = DiscreteDistribution(power);
  for (std::size_t i = 0; i < scene_->lights.size(); ++i) punctual_share_ += choice_.probability(i);
  environment_share_ = choice_.probability(scene_->lights.size());
}

LightSample LightTable::from_chosen(const LightQuery& query,
                                    const DiscreteDistribution::Choice& choice) const {
  const std::size_t light = choice.index;
  LightSample sample;
  if (light < scene_->lights.size()) {
    sample = from_punctual(query.from, scene_->lights[light]);
    sample.pdf = choice.probability;
    return sample;
  }
  if (light < first_sphere_) {
    set_sky(environment_->sample(query.u), sample);
  } else if (light < first_triangle()) {
    sample = from_sphere(query.from, spheres_[light - first_sphere_], query.u);
  } else {
    sample = from_triangle(query.from, triangles_[light - first_triangle()], query.u);
  }
  sample.pdf *= choice.probability;
  return sample;
}

LightSample LightTable::sample(Vec3f from, float select, Vec2f u) const {
  return from_chosen({from, select, u}, choice_.choose(select));
}

void LightTable::sample(std::span<const LightQuery> queries, LightSample* samples) const {
  constexpr std::size_t most = 16;
  assert(queries.size() <= most);
  Vec2f sky_u[most];
  EnvironmentSample sky[most];
  LightSample* of_sky[most];
  std::size_t count = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const DiscreteDistribution::Choice choice = choice_.choose(queries[i].select);
    if (choice.index != scene_->lights.size()) {
      samples[i] = from_chosen(queries[i], choice);
      continue;
    }
    sky_u[count] = queries[i].u;
    of_sky[count++] = &samples[i];
  }
  if (count == 0) return;
  environment_->sample({sky_u, count}, {sky, count});
  for (std::size_t i = 0; i < count; ++i) {
    *of_sky[i] = LightSample();
    set_sky(sky[i], *of_sky[i]);
    of_sky[i]->pdf *= environment_share_;
  }
}

LightSample LightTable::sample_punctual(Vec3f from, float select) const {
  // Chances are multiples of 2^-24; rounding must not lead to what follows the punctual lights.
  LightSample found = sample(from, std::min(select * punctual_share_, punctual_share_ - 0x1p-24f), {});
  found.pdf /= punctual_share_;
  return found;
}

LightSample LightTable::from_punctual(Vec3f from, const PunctualLight& light) const {
  LightSample sample;
  sample.is_delta = true;
  sample.radiance = light.intensity;
  if (light.kind == PunctualLight::Kind::directional) {
    sample.direction = -normalized(light.direction);
    return sample;
  }
  const Vec3f way = light.position - from;
  const float squared = dot(way, way);
  if (!(squared > 0)) return {};
  sample.distance = std::sqrt(squared);
  sample.direction = (1 / sample.distance) * way;
  sample.target = light.position;
  const float share = light.kind == PunctualLight::Kind::spot ? spot_share(light, -sample.direction) : 1.0f;
  sample.radiance = (share / squared) * light.intensity;
  return sample;
}

/// Uniform in the cone in which the sphere is seen; from inside uniform in all directions.
LightSample LightTable::from_sphere(Vec3f from, const SphereLight& light, Vec2f u) const {
  const Vec3f way = light.centre - from;
  const float squared = dot(way, way), radius = light.radius;
  const bool inside = is_inside(from, light);
  const float cap = inside ? 2.0f : one_minus_cosine(radius, squared);
  const LocalFrame frame = make_frame(squared > 0 ? normalized(way) : Vec3f{0, 1, 0});
  LightSample sample;
  sample.direction = frame.to_world(warp_to_cone(u, cap));
  sample.pdf = cone_pdf(cap);
  // Along the direction: projection of the centre, then half the chord, the nearer end from outside.
  const float along = dot(way, sample.direction);
  const float half = std::sqrt(std::max(0.0f, radius * radius - (squared - along * along)));
  sample.distance = inside ? along + half : along - half;
  const Vec3f normal = normalized(sample.distance * sample.direction - way);
  const float off = (inside ? -1.0f : 1.0f) * 64 * 0x1p-24f * (radius + length(light.centre));
  sample.target = light.centre + (radius + off) * normal;
  Vec2f texcoords[2];
  if (scene_->materials[light.material].emission_texture.texture >= 0) {
    texcoords[0] = texcoords[1] = sphere_texcoord(normal);
  }
  sample.radiance = emission(light.material, !inside, texcoords);
  return sample;
}

/// Uniform over the area; the density per steradian is distance^2 / (area |cos|).
LightSample LightTable::from_triangle(Vec3f from, const TriangleLight& light, Vec2f u) const {
  const Vec2f b = warp_to_triangle(u);
  const Vec3f point = light.corner + b.x * light.edge_u + b.y * light.edge_v;
  const Vec3f way = point - from;
  const float squared = dot(way, way);
  if (!(squared > 0)) return {};
  LightSample sample;
  sample.distance = std::sqrt(squared);
  sample.direction = (1 / sample.distance) * way;
  const float cosine = -dot(sample.direction, light.normal);
  if (cosine == 0 || !(light.area > 0)) return {};
  sample.pdf = squared / (light.area * std::abs(cosine));
  sample.target = point + (cosine > 0 ? light.offset : -light.offset) * light.normal;
  const Material& material = scene_->materials[light.material];
  Vec2f texcoords[2];
  if (material.emission_texture.texture >= 0 || material.alpha_mode != AlphaMode::opaque) {
    const Mesh& mesh = scene_->meshes[scene_->instances[light.object].mesh];
    const auto& c = mesh.triangles[light.triangle];
    for (int i = 0; i < 2; ++i) {
      const std::vector<Vec2f>& uv = mesh.texcoords[i];
      if (!uv.empty()) texcoords[i] = (1 - b.x - b.y) * uv[c[0]] + b.x * uv[c[1]] + b.y * uv[c[2]];
    }
  }
  sample.radiance = emission(light.material, cosine > 0, texcoords);
  if (material.alpha_mode != AlphaMode::opaque) {
    const float coverage = coverage_at(*scene_, material, texcoords);
    const bool mask = material.alpha_mode == AlphaMode::mask;
    const float covered = mask ? (coverage < material.alpha_cutoff ? 0.0f : 1.0f) : std::min(coverage, 1.0f);
    sample.radiance = covered * sample.radiance;
  }
  return sample;
}

float LightTable::sphere_pdf(Vec3f from, const SphereLight& light) const {
  if (is_inside(from, light)) return welkin::sphere_pdf();
  const Vec3f way = light.centre - from;
  return cone_pdf(one_minus_cosine(light.radius, dot(way, way)));
}

float LightTable::pdf_of_surface(Vec3f from, const Hit& hit, const Surface& surface) const {
  const std::uint32_t first = first_light_[hit.object];
  if (first == no_light) return 0;
  if (hit.object >= scene_->instances.size()) {
    return choice_.probability(first_sphere_ + first) * sphere_pdf(from, spheres_[first]);
  }
  const std::size_t light = first + hit.triangle;
  const Vec3f way = surface.position - from;
  const float squared = dot(way, way);
  const float area_cosine =
      triangles_[light].area * std::abs(dot(way, surface.geometric_normal)) / std::sqrt(squared);
  return area_cosine > 0 ? choice_.probability(first_triangle() + light) * squared / area_cosine : 0;
}

Rgb LightTable::emission(int index, bool front, const Vec2f (&texcoords)[2]) const {
  const Material& material = scene_->materials[index];
  if (!front && !material.double_sided) return {};
  if (material.emission_texture.texture < 0) return material.emission;
  const Texel texel = look_up(*scene_, material.emission_texture, texcoords);
  return material.emission * Rgb{texel[0], texel[1], texel[2]};
}

}  // namespace welkin
