#include <welkin/realtime/capture/surroundings.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr double flare_period = 4, burning = 3;  // s
constexpr int carousel_things = 6;

// In [0, 1), the same on every machine.
float hashed(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9E3779B1u ^ b * 0x85EBCA77u ^ c * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) / 16777216.0f;
}

constexpr Rgb flare_colors[flare_count] = {
    {1, 0.30f, 0.10f}, {1, 0.72f, 0.28f}, {0.25f, 1, 0.35f}, {0.45f, 0.6f, 1}};

float smooth_step(double x) {
  const double t = x < 0 ? 0 : x > 1 ? 1 : x;
  return static_cast<float>(t * t * (3 - 2 * t));
}

// Height over the floor of a thing thrown up with speed `up` (and how far it has gone along the floor, in seconds of its first speed), with bounces that
// halve the speed across the floor and the height's.
struct Flight {
  float height, along;
};

Flight flight(double seconds, double start_height, double up, double gravity) {
  double time = seconds, height = start_height, speed = up, along = 0, pace = 1;
  for (int bounce = 0; bounce < 4; ++bounce) {
    const double landing = (speed + std::sqrt(speed * speed + 2 * gravity * height)) / gravity;
    if (time < landing)
      return {static_cast<float>(height + speed * time - 0.5 * gravity * time * time),
              static_cast<float>(along + pace * time)};
    time -= landing;
    along += pace * landing;
    speed = 0.5 * (gravity * landing - speed);
    height = 0;
    pace *= 0.5;
  }
  return {0, static_cast<float>(along)};
}

Flare flare_at(const FlareField& field, std::uint32_t index, double time_seconds) {
  const double since = time_seconds + flare_period * index / flare_count + 100 * flare_period;
  const auto launch = static_cast<std::uint32_t>(since / flare_period);
  const double age = since - flare_period * launch;
  const float r = field.reach, azimuth = 2 * pi * hashed(index, launch, 1);
  const float aside = 0.35f + 0.5f * hashed(index, launch, 2), side = index % 2 == 0 ? 1.0f : -1.0f;
  const Vec3f inwards{-std::cos(azimuth), 0, -std::sin(azimuth)}, across{inwards.z, 0, -inwards.x};
  const Flight f = flight(age, 0.5 * r, 1.2 * r, 2.0 * r);
  Flare flare;
  flare.radius = 0.06f * r;
  flare.centre = field.centre - r * inwards + 0.75f * f.along * r * inwards + side * aside * r * across;
  flare.centre.y = field.floor + flare.radius + f.height;
  const float flicker = 1 + 0.12f * static_cast<float>(std::sin(37 * age + index));
  const float burns = smooth_step(age / 0.15) * (1 - smooth_step((age - burning + 0.6) / 0.6));
  flare.radiance = field.radiance * flicker * burns * flare_colors[index];
  return flare;
}

// The parallelogram as patches x patches quads.
void add_wall(Scene& scene, Vec3f corner, Vec3f across, Vec3f up, int patches, int material) {
  const float step = 1.0f / static_cast<float>(patches);
  for (int i = 0; i < patches * patches; ++i) {
    const Vec3f from = corner + (step * static_cast<float>(i % patches)) * across +
                       (step * static_cast<float>(i / patches)) * up;
    const Mesh patch = make_rectangle(from, step * across, step * up);
    Mesh& wall = i == 0 ? scene.meshes[static_cast<std::size_t>(add_mesh(scene, patch, material))]
                        : scene.meshes.back();
    if (i == 0) continue;
    const auto first = static_cast<std::uint32_t>(wall.positions.size());
    wall.positions.insert(wall.positions.end(), patch.positions.begin(), patch.positions.end());
    wall.normals.insert(wall.normals.end(), patch.normals.begin(), patch.normals.end());
    wall.tangents.insert(wall.tangents.end(), patch.tangents.begin(), patch.tangents.end());
    wall.tangent_signs.insert(wall.tangent_signs.end(), patch.tangent_signs.begin(),
                              patch.tangent_signs.end());
    wall.texcoords[0].insert(wall.texcoords[0].end(), patch.texcoords[0].begin(), patch.texcoords[0].end());
    for (const auto& t : patch.triangles)
      wall.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  add_instance(scene, static_cast<int>(scene.meshes.size()) - 1);
}

Material painted(Rgb color, Rgb emission = {}) {
  Material material;
  material.model = MaterialModel::lambert;
  material.base_color = color;
  material.emission = emission;
  return material;
}

// A wall from `corner` with a hole: [0.3, 0.7] of `across` and [0.35, 0.8] of `up`.
void add_wall_with_hole(Scene& scene, Vec3f corner, Vec3f across, Vec3f up, int patches, int material) {
  add_wall(scene, corner, 0.3f * across, up, patches, material);
  add_wall(scene, corner + 0.7f * across, 0.3f * across, up, patches, material);
  add_wall(scene, corner + 0.3f * across, 0.4f * across, 0.35f * up, patches, material);
  add_wall(scene, corner + 0.3f * across + 0.8f * up, 0.4f * across, 0.2f * up, patches, material);
}

// Walls face inwards: across x up points into the room.
void add_room(Scene& scene, Vec3f c, float r, float floor, int patches) {
  const int white = add_material(scene, painted({0.75f, 0.72f, 0.68f})),
            wood = add_material(scene, painted({0.42f, 0.26f, 0.14f}));
  const int red = add_material(scene, painted({0.6f, 0.12f, 0.08f})),
            blue = add_material(scene, painted({0.1f, 0.2f, 0.5f}));
  const float a = 2.4f * r, h = 3.4f * r;
  const Vec3f low{c.x - a, floor, c.z - a};
  const float w = 2 * a;
  add_wall(scene, low + Vec3f{0, 0, w}, {w, 0, 0}, {0, 0, -w}, patches, wood);
  add_wall_with_hole(scene, low + Vec3f{0, h, 0}, {w, 0, 0}, {0, 0, w}, patches, white);
  add_wall(scene, low, {w, 0, 0}, {0, h, 0}, patches, white);
  add_wall(scene, low + Vec3f{w, 0, w}, {-w, 0, 0}, {0, h, 0}, patches, white);
  add_wall_with_hole(scene, low + Vec3f{0, 0, w}, {0, 0, -w}, {0, h, 0}, patches, red);
  add_wall(scene, low + Vec3f{w, 0, 0}, {0, 0, w}, {0, h, 0}, patches, blue);
}

Mesh coarse_sphere() {
  std::vector<OutlinePoint> outline;
  constexpr int rows = 12;
  for (int i = 0; i <= rows; ++i) {
    const float angle = pi * (static_cast<float>(i) / rows - 0.5f);
    const Vec2f point{i == 0 || i == rows ? 0 : std::cos(angle), std::sin(angle)};
    outline.push_back({point, point});
  }
  return make_lathe(outline, 2 * rows);
}

// Blocks and lamps by turns.
void add_carousel(Scene& scene) {
  constexpr Rgb colors[carousel_things] = {{0.8f, 0.1f, 0.1f},   {9, 6, 3}, {0.1f, 0.7f, 0.15f}, {3, 6, 9},
                                           {0.15f, 0.2f, 0.85f}, {8, 2, 6}};
  for (int i = 0; i < carousel_things; ++i) {
    const bool lamp = i % 2 == 1;
    const int material = add_material(scene, lamp ? painted({0, 0, 0}, colors[i]) : painted(colors[i]));
    const Mesh mesh = lamp ? coarse_sphere() : make_box({-1, -1, -1}, {1, 1, 1});
    add_instance(scene, add_mesh(scene, mesh, material));
  }
}

Affine placed(Vec3f centre, float scale, float turn) {
  const float c = scale * std::cos(turn), s = scale * std::sin(turn);
  return {{c, 0, -s}, {0, scale, 0}, {s, 0, c}, centre};
}

}  // namespace

std::vector<Flare> flares_at(const FlareField& field, double time_seconds) {
  std::vector<Flare> flares;
  for (std::uint32_t i = 0; i < flare_count; ++i) flares.push_back(flare_at(field, i, time_seconds));
  return flares;
}

Surroundings::Surroundings(SurroundingsKind kind, const Bounds& about, int patches) : kind_(kind) {
  probe_ = 0.5f * (about.low + about.high);
  size_ = 0.5f * length(about.high - about.low);
  floor_ = about.low.y - 0.02f * size_;
  reach_ = 6 * size_;
  if (kind == SurroundingsKind::none) return;
  Scene scene;
  scene.source = "surroundings";
  if (kind == SurroundingsKind::carousel) {
    add_carousel(scene);
  } else {
    const Mesh ball = coarse_sphere();
    for (int i = 0; i < flare_count; ++i)
      add_instance(scene, add_mesh(scene, ball, add_material(scene, painted({0, 0, 0}))));
    if (kind == SurroundingsKind::room) add_room(scene, probe_, size_, floor_, patches);
  }
  scene_ = upload_scene(scene);
}

void Surroundings::move_to(double time_seconds, float flare_radiance) {
  flares_.clear();
  if (kind_ == SurroundingsKind::none) return;
  if (kind_ == SurroundingsKind::carousel) return move_carousel(time_seconds);
  flares_ = flares_at({probe_, 2 * size_, floor_, flare_radiance}, time_seconds);
  for (std::size_t i = 0; i < flares_.size(); ++i) {
    scene_.draws[i].to_world = placed(flares_[i].centre, flares_[i].radius, 0);
    scene_.materials[i].emission = flares_[i].radiance;
  }
}

void Surroundings::move_carousel(double time_seconds) {
  for (int i = 0; i < carousel_things; ++i) {
    const float turn = 2 * pi * static_cast<float>(std::fmod(time_seconds / 12 + i / 6.0, 1.0));
    const Vec3f round{std::cos(turn), 0.35f * std::sin(2 * turn + static_cast<float>(i)), std::sin(turn)};
    const float scale = (i % 2 == 1 ? 0.25f : 0.4f) * size_;
    scene_.draws[static_cast<std::size_t>(i)].to_world =
        placed(probe_ + 2.2f * size_ * round, scale, -2 * turn);
  }
}

void set_flares(const Program& program, const std::vector<Flare>& flares) {
  std::vector<Vec3f> places(flare_count), radiances(flare_count);
  for (std::size_t i = 0; i < flares.size(); ++i) {
    const float r = flares[i].radius;
    const Rgb light = pi * r * r * flares[i].radiance;
    places[i] = flares[i].centre;
    radiances[i] = {light.r, light.g, light.b};
  }
  program.set_vec3_array("flare_places", places);
  program.set_vec3_array("flare_intensities", radiances);
}

}  // namespace welkin
