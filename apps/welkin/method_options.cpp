#include "method_options.h"

#include <string>

#include "environment_options.h"

namespace welkin {
namespace {

struct Owner {
  const char* flag;
  FilterMethod method;
};

constexpr Owner owners[] = {
    {"--detail", FilterMethod::hierarchical}, {"--cut", FilterMethod::angular},
    {"--samples", FilterMethod::importance},  {"--level-bias", FilterMethod::importance},
    {"--scramble", FilterMethod::importance}, {"--seed", FilterMethod::importance},
    {"--tolerance", FilterMethod::frequency},
};

}  // namespace

void add_method_options(CLI::App& sub, FilterMethodOptions& options) {
  const std::string group = "Methods";
  sub.add_option("--detail", options.hierarchical.detail,
                 "hierarchical: nodes of the pyramid per scale of the kernel")
      ->check(CLI::Range(0.5, 64.0))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--cut", options.angular.cut_energy, "angular: the share of the lobe that is cut off")
      ->check(CLI::Range(1e-9, 0.5))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--samples", options.importance.samples, "importance: look-ups a texel")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--level-bias", options.importance.level_bias, "importance: added to the mip level")
      ->check(CLI::Range(-16.0, 16.0))
      ->capture_default_str()
      ->group(group);
  sub.add_flag("--scramble", options.importance.scramble, "importance: other points at every texel")
      ->group(group);
  sub.add_option("--seed", options.importance.seed, "importance: of --scramble")->group(group);
  sub.add_option("--tolerance", options.frequency.tolerance, "frequency: error aimed at, of the map's mean")
      ->check(CLI::Range(1e-6, 0.1))
      ->capture_default_str()
      ->group(group);
}

void check_method_options(const CLI::App& sub, std::optional<FilterMethod> method) {
  for (const Owner& owner : owners)
    if (method && owner.method != *method && sub.count(owner.flag) > 0)
      throw CLI::ValidationError(owner.flag,
                                 "is an option of --method " + std::string(filter_method_name(owner.method)));
}

}  // namespace welkin
