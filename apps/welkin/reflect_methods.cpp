#include "reflect_methods.h"

#include <fmt/format.h>

#include <memory>

#include <welkin/envmap/reflection/low_frequency.h>
#include <welkin/envmap/reflection/shrm.h>
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

}  // namespace

const std::vector<ReflectMethod>& reflect_methods() {
  static const std::vector<ReflectMethod> methods{
      {"lobes", "a lobe per view elevation, Kautz & McCool 2000", prepare_lobes_method},
      {"lobes-2", "the same, two lobes", prepare_two_lobes_method},
      {"lobes-published", "the same, one, the cosine outside of the integral",
       prepare_published_lobes_method},
      {"single-lobe", "one lobe scaled and turned, the same", prepare_single_lobe_method},
      {"lafortune", "lafortune:... alone, McAllister et al. 2002", prepare_lafortune_method},
      {"shrm", "spherical-harmonic reflection map within --error-bound, Ramamoorthi & Hanrahan 2002",
       prepare_shrm_method},
      {"low-frequency", "light of degree 4, Kautz, Sloan & Snyder 2002", prepare_low_frequency_method}};
  return methods;
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
