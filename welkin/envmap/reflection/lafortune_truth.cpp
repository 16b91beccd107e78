#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/patch_quadrature.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>

// The oracle of the Lafortune stack.

namespace welkin {
namespace {

double sharpest_width(const LafortuneBrdf& brdf) {
  double width = 1;
  for (const LafortuneLobe& lobe : brdf.lobes) width = std::min(width, 1 / std::sqrt(lobe.exponent + 1));
  return width;
}

// As many nodes a side as the sharpest lobe needs, and no fewer than six where the horizon cuts the texel.
int nodes_for(double width, double half, double height) {
  const int smooth = std::clamp(patch_nodes(width, half), 2, 24);
  return std::abs(height) < 2 * half ? std::max(6, smooth) : smooth;
}

void add_texel(const SpherePatch& patch, const QuadratureRule& rule, const TangentQuery& query,
               Vec3 bitangent, LocalVec view, const LafortuneBrdf& brdf, const float* radiance, double* sum) {
  const double half_theta = (patch.theta1 - patch.theta0) / 2, half_phi = (patch.phi1 - patch.phi0) / 2;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double theta = patch.theta0 + half_theta * (1 + rule.nodes[i]);
    const double sine = std::sin(theta), cosine = std::cos(theta);
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const double phi = patch.phi0 + half_phi * (1 + rule.nodes[j]);
      const Vec3 d{sine * std::cos(phi), cosine, sine * std::sin(phi)};
      const LocalVec light{dot(d, query.tangent), dot(d, bitangent), dot(d, query.normal)};
      if (light.z <= 0) continue;
      const auto f = evaluate(brdf, light, view);
      const double weight = half_theta * half_phi * rule.weights[i] * rule.weights[j] * sine * light.z;
      for (int c = 0; c < 3; ++c) sum[c] += weight * f[c] * static_cast<double>(radiance[c]);
    }
  }
}

}  // namespace

std::vector<double> reflect_lafortune_brute_force(const Image& radiance, const LafortuneBrdf& brdf,
                                                  std::span<const TangentQuery> queries) {
  std::vector<QuadratureRule> rules(25);
  for (int n = 1; n < 25; ++n) rules[n] = gauss_legendre(n);
  const double width = sharpest_width(brdf), half = std::numbers::pi / (2.0 * radiance.height);
  std::vector<double> reflected(3 * queries.size());
  parallel_for(queries.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      const TangentQuery& query = queries[q];
      const Vec3 bitangent = cross(query.normal, query.tangent);
      const LocalVec view{dot(query.view, query.tangent), dot(query.view, bitangent),
                          dot(query.view, query.normal)};
      if (view.z <= 0) continue;
      for (int y = 0; y < radiance.height; ++y)
        for (int x = 0; x < radiance.width; ++x) {
          const SpherePatch patch = equirect_patch(radiance.width, radiance.height, x, y);
          const double theta = (patch.theta0 + patch.theta1) / 2, phi = (patch.phi0 + patch.phi1) / 2;
          const double height = std::sin(theta) * std::cos(phi) * query.normal.x +
                                std::cos(theta) * query.normal.y +
                                std::sin(theta) * std::sin(phi) * query.normal.z;
          if (height < -2 * half) continue;
          add_texel(patch, rules[nodes_for(width, half, height)], query, bitangent, view, brdf,
                    radiance.at(x, y), &reflected[3 * q]);
        }
    }
  });
  return reflected;
}

}  // namespace welkin
