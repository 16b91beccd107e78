#pragma once
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <welkin/raytrace/surface.h>

// Small closed meshes and random rays.

namespace welkin::oracle {

/// The cube [-1, 1]^3, triangles counter-clockwise seen from outside, corners shared.
inline Mesh cube_mesh() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// The unit sphere as an icosahedron whose faces are cut in four `levels` times; corners shared; normals exact.
inline Mesh icosphere(int levels) {
  Mesh mesh;
  const float t = (1 + std::sqrt(5.0f)) / 2;
  for (const auto& [x, y] :
       {std::pair{1.0f, t}, std::pair{-1.0f, t}, std::pair{1.0f, -t}, std::pair{-1.0f, -t}}) {
    mesh.positions.push_back(normalized({x, y, 0}));
    mesh.positions.push_back(normalized({0, x, y}));
    mesh.positions.push_back(normalized({y, 0, x}));
  }
  // Faces: all triples at the edge's distance, turned outwards.
  const auto near = [&](int a, int b) {
    const Vec3f d = mesh.positions[a] - mesh.positions[b];
    return dot(d, d) < 1.2f;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const Vec3f n = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        if (dot(n, mesh.positions[a]) > 0) {
          mesh.triangles.push_back({a, b, c});
        } else {
          mesh.triangles.push_back({a, c, b});
        }
      }
    }
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), mesh.positions.size());
      if (fresh) mesh.positions.push_back(normalized(mesh.positions[a] + mesh.positions[b]));
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  mesh.normals = mesh.positions;
  return mesh;
}

/// A scene of one mesh, placed by each of these.
inline Scene scene_of(Mesh mesh, const std::vector<Affine>& places = {Affine()}) {
  Scene scene;
  scene.source = "test";
  scene.materials.push_back({});
  scene.meshes.push_back(std::move(mesh));
  for (const Affine& place : places) scene.instances.push_back({0, place});
  return scene;
}

inline Affine scaled(float factor, Vec3f origin = {}) {
  return {{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}, origin};
}

inline Vec3f random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  while (true) {
    const Vec3f v{normal(random), normal(random), normal(random)};
    if (dot(v, v) > 1e-3f) return normalized(v);
  }
}

}  // namespace welkin::oracle
