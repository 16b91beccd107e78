#include <welkin/envmap/reflection/split_sum.h>

#include <fmt/format.h>

#include <cmath>

#include <welkin/envmap/ibl.h>
#include <welkin/error.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/resample.h>

namespace welkin {

PrefilteredChain make_prefiltered_chain(const Image& radiance, const PrefilterOptions& options) {
  if (options.size < 2 || options.size > 8192)
    throw Error(fmt::format("the size must lie in [2, 8192], not {}", options.size));
  int most = 1;
  while (options.size >> most) ++most;
  const int levels = options.levels == 0 ? std::max(2, default_levels(options.size)) : options.levels;
  if (levels < 2 || levels > most)
    throw Error(fmt::format("a cube of {} has 2 to {} levels, not {}", options.size, most, levels));
  std::vector<FilterTarget> targets;
  for (int k = 1; k < levels; ++k) {
    const double r = level_to_perceptual_roughness(options.law, k, levels, options.size);
    targets.push_back({kernel_for_alpha(KernelKind::ggx, r * r), options.size >> k});
  }
  PrefilteredChain chain;
  chain.law = options.law;
  chain.levels.levels = filter_environment(radiance, targets, options.filter);
  chain.levels.levels.insert(chain.levels.levels.begin(), equirect_to_cube(radiance, options.size));
  return chain;
}

std::array<double, 3> look_up(const PrefilteredChain& chain, Vec3 direction, double perceptual_roughness) {
  const double level = perceptual_roughness_to_level(
      chain.law, perceptual_roughness, static_cast<int>(chain.levels.levels.size()), chain.levels.size());
  float rgb[4];
  look_up_cube(chain.levels, direction, level, rgb);
  return {rgb[0], rgb[1], rgb[2]};
}

SplitSum prepare_split_sum(const Image& radiance, const std::array<double, 3>& f0, double alpha,
                           const PrefilterOptions& options) {
  if (!(alpha >= 1e-3 && alpha <= 1)) throw Error(fmt::format("alpha must lie in [0.001, 1], not {}", alpha));
  for (double f : f0)
    if (!(f >= 0 && f <= 1)) throw Error(fmt::format("f0 must lie in [0, 1], not {}", f));
  return {make_prefiltered_chain(radiance, options), f0, alpha};
}

std::array<double, 3> reflect(const SplitSum& surface, const ReflectionQuery& query) {
  const double cos_view = dot(query.normal, query.view);
  if (cos_view <= 0) return {};
  const Vec3 mirrored = 2 * cos_view * query.normal - query.view;
  const DfgValue dfg = integrate_dfg(std::min(1.0, cos_view), surface.alpha);
  std::array<double, 3> rgb = look_up(surface.chain, mirrored, std::sqrt(surface.alpha));
  for (int c = 0; c < 3; ++c) rgb[c] *= surface.f0[c] * dfg.scale + dfg.bias;
  return rgb;
}

}  // namespace welkin
