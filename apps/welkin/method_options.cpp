#include "method_options.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "environment_options.h"

namespace welkin {
namespace {

struct Owner {
  const char* flag;
  FilterMethod method;
};

constexpr Owner owners[] = {
    {"--detail", FilterMethod::hierarchical},   {"--cut", FilterMethod::angular},
    {"--border", FilterMethod::bordered},       {"--border", FilterMethod::paraboloid},
    {"--square", FilterMethod::bordered},       {"--solid-angles", FilterMethod::bordered},
    {"--box-bias", FilterMethod::box},          {"--samples", FilterMethod::importance},
    {"--level-bias", FilterMethod::importance}, {"--scramble", FilterMethod::importance},
    {"--seed", FilterMethod::importance},       {"--taps", FilterMethod::quick},
    {"--tolerance", FilterMethod::frequency},
};

void add_planar_options(CLI::App& sub, FilterMethodOptions& options, const std::string& group) {
  const auto set_border = [&options](double border) {
    options.bordered.border = options.paraboloid.border = border;
  };
  sub.add_option_function<double>(
         "--border", set_border,
         "bordered, paraboloid: how far a picture goes on beyond its edge, in widths "
         "of a face or radii (default: as far as the kernel reaches)")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 3.0))
      ->group(group);
  sub.add_flag("--square", options.bordered.box,
               "bordered: a square instead of the kernel, as hardware filters")
      ->group(group);
  sub.add_flag("--solid-angles", options.bordered.solid_angles, "bordered: texels weighed by solid angle")
      ->group(group);
  sub.add_option("--box-bias", options.box.bias, "box: the mip level (default: fitted to the kernel)")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 16.0))
      ->group(group);
  sub.add_option("--taps", options.quick.taps, "quick: look-ups a texel")
      ->check(CLI::Range(2, 64))
      ->capture_default_str()
      ->group(group);
}

void add_importance_options(CLI::App& sub, ImportanceOptions& options, const std::string& group) {
  sub.add_option("--samples", options.samples, "importance: look-ups a texel")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--level-bias", options.level_bias, "importance: added to the mip level")
      ->check(must_be_finite)
      ->check(CLI::Range(-16.0, 16.0))
      ->capture_default_str()
      ->group(group);
  sub.add_flag("--scramble", options.scramble, "importance: other points at every texel")->group(group);
  sub.add_option("--seed", options.seed, "importance: of --scramble")->group(group);
}

}  // namespace

void add_method_options(CLI::App& sub, FilterMethodOptions& options) {
  const std::string group = "Methods";
  sub.add_option("--detail", options.hierarchical.detail,
                 "hierarchical: nodes of the pyramid per scale of the kernel")
      ->check(must_be_finite)
      ->check(CLI::Range(0.5, 64.0))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--cut", options.angular.cut_energy, "angular: the share of the lobe that is cut off")
      ->check(must_be_finite)
      ->check(CLI::Range(1e-9, 0.5))
      ->capture_default_str()
      ->group(group);
  add_planar_options(sub, options, group);
  add_importance_options(sub, options.importance, group);
  sub.add_option("--tolerance", options.frequency.tolerance, "frequency: error aimed at, of the map's mean")
      ->check(must_be_finite)
      ->check(CLI::Range(1e-6, 0.1))
      ->capture_default_str()
      ->group(group);
}

void check_method_options(const CLI::App& sub, std::optional<FilterMethod> method) {
  for (const Owner& owner : owners) {
    const bool belongs = !method || std::any_of(std::begin(owners), std::end(owners), [&](const Owner& o) {
      return o.method == *method && std::string_view(o.flag) == owner.flag;
    });
    if (!belongs && sub.count(owner.flag) > 0)
      throw CLI::ValidationError(owner.flag,
                                 "is an option of --method " + std::string(filter_method_name(owner.method)));
  }
}

}  // namespace welkin
