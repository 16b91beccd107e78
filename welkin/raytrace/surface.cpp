#include <welkin/raytrace/surface.h>

#include <algorithm>
#include <cmath>

#include <welkin/parallel/prefetch.h>
#include <welkin/raytrace/texture_lookup.h>

namespace welkin {
namespace {

constexpr float rounding = 0x1p-24f;  // largest relative error of one operation

/// |v| in the norm of the largest coordinate.
float size_of(Vec3f v) { return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z)); }

struct Corners {
  Vec3f p[3];
};

Corners corners_of(const PlacedMesh& placed, const std::array<std::uint32_t, 3>& triangle) {
  Corners c;
  for (int i = 0; i < 3; ++i) {
    c.p[i] = placed.positions[triangle[i]];
    if (!placed.in_world) c.p[i] = placed.to_world.point(c.p[i]);
  }
  return c;
}

/// How far the point w p0 + u p1 + v p2 lies from the plane, and how far off the tree's plane test is there.
/// Let e be the unit of rounding, m the largest coordinate of the corners, a and b two edges, n = a x b.
/// The point: each coordinate is three products and two sums of weights that are themselves off by 2 e (their sum is off
/// from 1 by some 4 e, which scales the point): together below 9 e m a coordinate, 16 e m in length.
/// The test: Embree moves the corners to the ray's origin (e of at most the longest edge L) and takes their distance along
/// n; n is a difference of products of size |a| |b|, so its direction is off by 4 e |a| |b| / |n|, which tilts the plane
/// by that much times L. For needles that is the larger part.
/// Through an instance, placed.transform_error of all coordinates involved comes on top.
float error_of(const PlacedMesh& placed, const Corners& c, Vec3f a, Vec3f b, float doubled_area) {
  const float largest = std::max(std::max(size_of(c.p[0]), size_of(c.p[1])), size_of(c.p[2]));
  const float aa = dot(a, a), bb = dot(b, b);
  const Vec3f third = b - a;
  const float longest_squared = std::max(std::max(aa, bb), dot(third, third));
  const float tilt = std::min(std::sqrt(aa * bb * longest_squared) / doubled_area, largest);
  return rounding * (16 * largest + 8 * tilt) + placed.transform_error * (largest + placed.origin_size);
}

/// The plane of a triangle with edges a, b: |a x b| (not 0, for what divides by it), and its unit normal.
struct Facet {
  float doubled_area;
  Vec3f normal;
};
/// The squares of |a x b| leave the range of floats where edges are below 1e-9 or above 1e9 metres: those are brought to a
/// length of about 1 first. What is too small even so, and was hardly hit, faces the ray.
Facet facet_of(Vec3f a, Vec3f b, Vec3f ray_direction) {
  constexpr float least_area = 1e-37f;
  const Vec3f across = cross(a, b);
  const float squared = dot(across, across);
  if (squared > 1e-34f && squared < 1e37f) {
    const float doubled = std::sqrt(squared);
    return {doubled, (1 / doubled) * across};
  }
  const float size = std::max(std::max(size_of(a), size_of(b)), 1e-30f);
  const Vec3f scaled = cross((1 / size) * a, (1 / size) * b);
  const float doubled = length(scaled);
  if (!(doubled > 1e-17f)) return {least_area, -ray_direction};
  return {std::max(size * size * doubled, least_area), (1 / doubled) * scaled};
}

struct Weights {
  float w, u, v;
};

/// The hit's weights, none of them so small that the point could lie beyond an edge by its rounding: where two walls meet
/// at an edge, a point behind the other wall would look out of the room. An edge is 4 errors away when the weight of the
/// corner across it is 4 errors over the triangle's height, and the smallest height is 2 area / longest edge.
Weights inside_weights(const Hit& hit, float error, float doubled_area, float longest) {
  const float least = std::min(4 * error * longest / doubled_area, 0.25f);
  const float w = std::max(1 - hit.u - hit.v, least), u = std::max(hit.u, least), v = std::max(hit.v, least);
  const float scale = 1 / (w + u + v);
  return {scale * w, scale * u, scale * v};
}

template <class T>
T blended(const std::vector<T>& values, const std::array<std::uint32_t, 3>& triangle, Weights by) {
  return by.w * values[triangle[0]] + by.u * values[triangle[1]] + by.v * values[triangle[2]];
}

/// dp/du of texture coordinates that are linear over the triangle, and whether (dp/du, -dp/dv, normal) is right-handed;
/// v grows downwards, a normal map's green upwards. Nothing (0, 0, 0) where the coordinates are degenerate.
struct TextureTangent {
  Vec3f tangent;
  float sign = 1;
};
TextureTangent texture_tangent(const std::vector<Vec2f>& uv, const std::array<std::uint32_t, 3>& triangle,
                               Vec3f a, Vec3f b) {
  const Vec2f s = uv[triangle[1]] - uv[triangle[0]], t = uv[triangle[2]] - uv[triangle[0]];
  const float turn =
      s.x * t.y - s.y * t.x;  // > 0: v, seen from the front, is 90 degrees counter-clockwise of u
  if (turn == 0) return {};
  const Vec3f along = t.y * a - s.y * b;
  return {turn < 0 ? -along : along, turn < 0 ? 1.0f : -1.0f};
}

void set_shading(Surface& surface, const PlacedMesh& placed, const std::array<std::uint32_t, 3>& triangle,
                 Weights by, Vec3f a, Vec3f b) {
  const Mesh& mesh = *placed.mesh;
  Vec3f normal = surface.geometric_normal;
  if (!mesh.normals.empty()) {
    Vec3f smooth = blended(mesh.normals, triangle, by);
    if (!placed.unmoved) smooth = transform_normal(placed.to_world, smooth);
    const float squared = dot(smooth, smooth);
    if (squared > 1e-20f) {
      const float side = dot(smooth, normal) < 0 ? -1.0f : 1.0f;
      normal = (side / std::sqrt(squared)) * smooth;
    }
  }
  if (!mesh.tangents.empty()) {
    Vec3f tangent = blended(mesh.tangents, triangle, by);
    if (!placed.unmoved) tangent = placed.to_world.vector(tangent);
    surface.shading = make_frame(normal, tangent);
    const float sign = mesh.tangent_signs.empty() ? 1.0f : mesh.tangent_signs[triangle[0]];
    surface.bitangent_sign = placed.mirrored ? -sign : sign;
  } else if (!mesh.texcoords[0].empty()) {
    const TextureTangent made = texture_tangent(mesh.texcoords[0], triangle, a, b);
    surface.shading = make_frame(normal, made.tangent);
    surface.bitangent_sign = placed.mirrored ? -made.sign : made.sign;
  } else {
    surface.shading = make_frame(normal);
  }
}

Surface on_mesh(const PlacedMesh& placed, const Hit& hit, const Ray& ray) {
  const Mesh& mesh = *placed.mesh;
  const auto& triangle = mesh.triangles[hit.triangle];
  const Corners c = corners_of(placed, triangle);
  const Vec3f a = c.p[1] - c.p[0], b = c.p[2] - c.p[0];
  const auto [doubled_area, normal] = facet_of(a, b, ray.direction);
  Surface surface;
  surface.position_error = error_of(placed, c, a, b, doubled_area);
  const Vec3f third = b - a;
  const float longest = std::sqrt(std::max(std::max(dot(a, a), dot(b, b)), dot(third, third)));
  const Weights by = inside_weights(hit, surface.position_error, doubled_area, longest);
  surface.position = by.w * c.p[0] + by.u * c.p[1] + by.v * c.p[2];
  surface.geometric_normal = placed.mirrored ? -normal : normal;
  surface.material = mesh.material;
  surface.front = dot(ray.direction, surface.geometric_normal) < 0;
  for (int i = 0; i < 2; ++i) {
    if (!mesh.texcoords[i].empty()) surface.texcoords[i] = blended(mesh.texcoords[i], triangle, by);
  }
  set_shading(surface, placed, triangle, by, a, b);
  return surface;
}

/// The point is the hit put back on the sphere along its radius: |position - centre| is right to 4 units of rounding of
/// the radius and one of the coordinates. Embree asks whether a ray's distance from the centre is below the radius:
/// squares of the radius off by some 8 e, so a ray may seem to dip into the sphere by 4 e of the radius.
Surface on_sphere(const Sphere& sphere, bool textured, const Hit& hit, const Ray& ray) {
  Surface surface;
  const Vec3f to_hit = ray.origin + hit.distance * ray.direction - sphere.centre;
  const Vec3f normal = normalized(to_hit);
  surface.position = sphere.centre + sphere.radius * normal;
  surface.position_error = rounding * (16 * sphere.radius + 4 * size_of(sphere.centre));
  surface.geometric_normal = normal;
  surface.shading = make_frame(normal, {-normal.z, 0, normal.x});
  surface.bitangent_sign = -1;  // u runs leftwards seen from outside
  if (textured) surface.texcoords[0] = surface.texcoords[1] = sphere_texcoord(normal);
  surface.material = sphere.material;
  surface.front = dot(ray.direction, normal) < 0;
  return surface;
}

bool is_textured(const Material& m) {
  return m.base_color_texture.texture >= 0 || m.metallic_texture.texture >= 0 ||
         m.roughness_texture.texture >= 0 || m.normal_texture.texture >= 0 || m.emission_texture.texture >= 0;
}

}  // namespace

void prefetch_surfaces(const RayScene& scene, std::uint32_t met, const Hit* hits) {
  const std::vector<PlacedMesh>& placed = scene.placed();
  const auto for_meshes = [&](auto&& visit) {
    for (std::uint32_t left = met, i = 0; left != 0; left >>= 1, ++i) {
      if ((left & 1) != 0 && hits[i].object < placed.size()) visit(placed[hits[i].object], hits[i].triangle);
    }
  };
  for_meshes([](const PlacedMesh& p, std::uint32_t triangle) { prefetch(&p.mesh->triangles[triangle]); });
  for_meshes([](const PlacedMesh& p, std::uint32_t triangle) {
    for (const std::uint32_t corner : p.mesh->triangles[triangle]) {
      prefetch(p.positions + corner);
      if (!p.mesh->normals.empty()) prefetch(&p.mesh->normals[corner]);
    }
  });
}

Surface surface_at(const RayScene& scene, const Hit& hit, const Ray& ray) {
  const std::vector<PlacedMesh>& placed = scene.placed();
  if (hit.object < placed.size()) return on_mesh(placed[hit.object], hit, ray);
  const Sphere& sphere = scene.scene().spheres[hit.object - placed.size()];
  return on_sphere(sphere, is_textured(scene.scene().materials[sphere.material]), hit, ray);
}

}  // namespace welkin
