#include "reflect_methods.h"

#include <fmt/format.h>

#include <memory>

#include <welkin/brdf/brdf_spec.h>
#include <welkin/envmap/reflection/fresnel_blend.h>
#include <welkin/envmap/reflection/low_frequency.h>
#include <welkin/envmap/reflection/shrm.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/error.h>

#include "reflect_lobe_methods.h"

namespace welkin {
namespace {

PreparedReflection prepare_shrm_method(const ReflectInput& input) {
  ShrmOptions options;
  options.error_bound = input.error_bound;
  auto map = std::make_shared<const ReflectionMap>(prepare_shrm(input.radiance, input.brdf, options));
  const ShrmReport& report = map->report;
  return {[map](const ReflectionQuery& query) { return reflect(*map, query); },
          fmt::format("F {}, P {} about the {}, {} maps of {} x {}, predicted {:.2e}{}", report.degree,
                      report.order, report.frame == ReflectionFrame::normal ? "normal" : "mirrored view",
                      report.maps, report.columns, report.rows, report.predicted_error,
                      report.bound_met ? "" : " (bound not met)")};
}

PreparedReflection prepare_low_frequency_method(const ReflectInput& input) {
  auto low =
      std::make_shared<const LowFrequencyReflection>(prepare_low_frequency(input.radiance, input.brdf));
  return {[low](const ReflectionQuery& query) { return reflect(*low, query); },
          fmt::format("25 coefficients, {} elevations, predicted {:.2e}", low->views,
                      low->report.predicted_error)};
}

GgxParameters ggx_of(const ReflectInput& input) {
  if (const auto parameters = parse_ggx_spec(input.brdf_spec)) return *parameters;
  throw Error(fmt::format("needs a BRDF ggx:ALPHA[,F0], not {}", input.brdf_spec));
}

PreparedReflection prepare_split_sum_method(const ReflectInput& input) {
  const GgxParameters ggx = ggx_of(input);
  auto surface = std::make_shared<const SplitSum>(prepare_split_sum(input.radiance, ggx.f0, ggx.alpha));
  return {[surface](const ReflectionQuery& query) { return reflect(*surface, query); },
          fmt::format("{} levels of {}, 1 look-up", surface->chain.levels.levels.size(),
                      surface->chain.levels.size())};
}

PreparedReflection prepare_stretched_method(const ReflectInput& input) {
  const GgxParameters ggx = ggx_of(input);
  auto surface =
      std::make_shared<const StretchedTaps>(prepare_stretched_taps(input.radiance, ggx.f0, ggx.alpha));
  return {[surface](const ReflectionQuery& query) { return reflect(*surface, query); },
          fmt::format("{} levels of {}, {} look-ups, table {} x {}", surface->chain.levels.levels.size(),
                      surface->chain.levels.size(), surface->table.taps, surface->table.cos_size,
                      surface->table.roughness_size)};
}

PreparedReflection prepare_fresnel_blend_method(const ReflectInput& input) {
  const auto material = parse_fresnel_blend_spec(input.brdf_spec);
  if (!material)
    throw Error(
        fmt::format("needs a BRDF fresnel-blend:... or fresnel-blend-schlick:..., not {}", input.brdf_spec));
  auto surface = std::make_shared<const FresnelBlend>(prepare_fresnel_blend(input.radiance, *material));
  return {
      [surface](const ReflectionQuery& query) { return reflect(*surface, query); },
      fmt::format("irradiance of {}, Phong of {}", surface->irradiance_over_pi.size, surface->glossy.size)};
}

}  // namespace

const std::vector<ReflectMethod>& reflect_methods() {
  static const std::vector<ReflectMethod> methods{
      {"lobes", "a lobe per view elevation, Kautz & McCool 2000", prepare_lobes_method, true},
      {"lobes-2", "the same, two lobes", prepare_two_lobes_method, true},
      {"lobes-published", "the same, one, the cosine outside of the integral", prepare_published_lobes_method,
       true},
      {"single-lobe", "one lobe scaled and turned, the same", prepare_single_lobe_method, true},
      {"lafortune", "lafortune:... alone, McAllister et al. 2002", prepare_lafortune_method, true},
      {"shrm", "spherical-harmonic reflection map within --error-bound, Ramamoorthi & Hanrahan 2002",
       prepare_shrm_method},
      {"low-frequency", "light of degree 4, Kautz, Sloan & Snyder 2002", prepare_low_frequency_method},
      {"split-sum", "one look-up of a prefiltered chain, Karis 2013 (ggx)", prepare_split_sum_method},
      {"stretched", "three fitted look-ups of the same chain (ggx)", prepare_stretched_method},
      {"fresnel-blend", "irradiance and Phong maps mixed by Fresnel (fresnel-blend)",
       prepare_fresnel_blend_method}};
  return methods;
}

PreparedReflection prepare(const ReflectMethod& method, const ReflectInput& input) {
  if (input.anisotropic && method.name != "lafortune")
    throw Error(fmt::format("{}: is for isotropic BRDFs (CX = CY); choose --method lafortune or brute",
                            input.brdf_spec));
  return method.prepare(input);
}

const ReflectMethod& find_reflect_method(std::string_view name) {
  std::string choices = "brute";
  for (const ReflectMethod& method : reflect_methods()) {
    if (method.name == name) return method;
    choices += fmt::format(", {}", method.name);
  }
  throw Error(fmt::format("unknown method \"{}\"; choose one of {}, all", name, choices));
}

}  // namespace welkin
