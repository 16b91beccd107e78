#include <welkin/sh/map_projection.h>

#include <algorithm>
#include <string>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

struct Texels {
  MapShape shape;
  int channels = 3;
  const float* values = nullptr;

  const float* at(int x, int y) const {
    return values + (static_cast<std::size_t>(y) * shape.width + x) * channels;
  }
};

void check(const Texels& texels, std::size_t count, int max_degree) {
  check_map_shape(texels.shape);
  if (texels.channels < 1 ||
      count != static_cast<std::size_t>(texels.shape.width) * texels.shape.height * texels.channels)
    throw Error("a map of " + std::to_string(texels.shape.width) + " x " +
                std::to_string(texels.shape.height) + " texels holds " + std::to_string(count) + " numbers");
  if (max_degree < 0 || max_degree > max_projection_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_projection_degree));
}

void add_basis(std::span<double> sum, Vec3 direction, double weight, int max_degree,
               std::span<double> basis) {
  evaluate_sh_basis(direction, max_degree, basis);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * basis[i];
}

// Sums texel value * texel_basis(x, y, out) over all texels; make_texel_basis makes one for each chunk of rows.
template <class MakeTexelBasis>
ShCoefficients project_texels(const Texels& texels, int max_degree, MakeTexelBasis&& make_texel_basis) {
  auto partials = parallel_partials<ShCoefficients>(
      texels.shape.height, 8, [&](ShCoefficients& sum, std::size_t begin, std::size_t end) {
        sum = ShCoefficients(max_degree, texels.channels);
        std::vector<double> integrals(sh_count(max_degree));
        auto texel_basis = make_texel_basis();
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          for (int x = 0; x < texels.shape.width; ++x) {
            std::fill(integrals.begin(), integrals.end(), 0.0);
            texel_basis(x, y, integrals);
            const float* value = texels.at(x, y);
            for (std::size_t i = 0; i < integrals.size(); ++i)
              for (int c = 0; c < texels.channels; ++c)
                sum.values[i * texels.channels + c] += integrals[i] * value[c];
          }
        }
      });
  for (std::size_t i = 1; i < partials.size(); ++i)
    for (std::size_t k = 0; k < partials[0].values.size(); ++k)
      partials[0].values[k] += partials[i].values[k];
  return partials[0];
}

ShCoefficients project_centres(const Texels& texels, int max_degree) {
  return project_texels(texels, max_degree, [&] {
    return
        [&, basis = std::vector<double>(sh_count(max_degree))](int x, int y, std::span<double> out) mutable {
          const double solid_angle = map_texel_solid_angle(texels.shape, x, y);
          if (solid_angle > 0)
            add_basis(out, map_texel_direction(texels.shape, x, y), solid_angle, max_degree, basis);
        };
  });
}

ShCoefficients project_integrated(const Texels& texels, int max_degree) {
  const TexelNodes all_nodes(texels.shape, max_degree, TexelRule::integrated);
  return project_texels(texels, max_degree, [&] {
    return [&, nodes = all_nodes, basis = std::vector<double>(sh_count(max_degree))](
               int x, int y, std::span<double> out) mutable {
      for (const TexelNode& node : nodes.of(x, y))
        add_basis(out, nodes.direction(x, y, node), node.weight, max_degree, basis);
    };
  });
}

}  // namespace

ShCoefficients project_map(const SphereMap& radiance, int max_degree, TexelRule rule) {
  const Texels texels{radiance.shape(), radiance.image.channels, radiance.image.pixels.data()};
  check(texels, radiance.image.pixels.size(), max_degree);
  if (rule == TexelRule::centre) return project_centres(texels, max_degree);
  if (radiance.mapping == Mapping::equirectangular) {
    if (texels.channels == 2 || texels.channels > 4)
      throw Error("an equirectangular map of " + std::to_string(texels.channels) +
                  " channels cannot be integrated");
    return project_equirect(radiance.image, max_degree);
  }
  return project_integrated(texels, max_degree);
}

ShCoefficients project_cube(const Cube& radiance, int max_degree, TexelRule rule) {
  const Texels texels{map_shape(Mapping::cube, radiance.size), radiance.channels, radiance.texels.data()};
  check(texels, radiance.texels.size(), max_degree);
  return rule == TexelRule::centre ? project_centres(texels, max_degree)
                                   : project_integrated(texels, max_degree);
}

}  // namespace welkin
