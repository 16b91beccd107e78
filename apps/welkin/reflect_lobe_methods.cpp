#include "reflect_lobe_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/envmap/reflection/lobe_stack.h>
#include <welkin/error.h>

namespace welkin {
namespace {

PreparedReflection with_stack(LobeStack prepared) {
  const auto stack = std::make_shared<const LobeStack>(std::move(prepared));
  const double worst = *std::max_element(stack->fit_errors.begin(), stack->fit_errors.end());
  return {[stack](const ReflectionQuery& query) { return reflect(*stack, query); },
          fmt::format("{} views, {} cube{}, fit within {:.1f} to {:.0f} %", stack->view_angles.size(),
                      stack->cubes.size(), stack->cubes.size() == 1 ? "" : "s",
                      100 * stack->fit_errors.front(), 100 * worst),
          {},
          [stack] { return stack_files(*stack); }};
}

}  // namespace

PreparedReflection prepare_lobes_method(const ReflectInput& input) {
  return with_stack(prepare_lobe_stack(input.radiance, input.brdf));
}

PreparedReflection prepare_two_lobes_method(const ReflectInput& input) {
  return with_stack(prepare_lobe_stack(input.radiance, input.brdf, {.lobes = 2}));
}

PreparedReflection prepare_published_lobes_method(const ReflectInput& input) {
  // Small cubes: its lobes end in spikes at the horizon, which are dear to filter, and its error is 33 % and more.
  return with_stack(
      prepare_lobe_stack(input.radiance, input.brdf, {.target = LobeTarget::brdf, .largest_size = 32}));
}

PreparedReflection prepare_single_lobe_method(const ReflectInput& input) {
  return with_stack(prepare_single_lobe(input.radiance, input.brdf));
}

PreparedReflection prepare_lafortune_method(const ReflectInput& input) {
  if (input.brdf_spec.rfind("lafortune:", 0) != 0) throw Error("works for lafortune:... alone");
  const LafortuneBrdf brdf = parse_lafortune(input.brdf_spec);
  const auto stack = std::make_shared<const LafortuneStack>(prepare_lafortune_stack(input.radiance));
  return {[stack, brdf](const ReflectionQuery& query) { return reflect(*stack, brdf, query); },
          fmt::format("phong exponents {:g} to 0 in {} levels", stack->exponents.front(),
                      stack->exponents.size()),
          [stack, brdf](const TangentQuery& query) { return reflect(*stack, brdf, query); },
          [stack] { return stack_files(*stack); }};
}

}  // namespace welkin
