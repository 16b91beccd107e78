#include <welkin/envmap/reflection/lobe_stack.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/filter.h>
#include <welkin/envmap/kernel_table.h>
#include <welkin/error.h>
#include <welkin/sphere/cube_lookup.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double last_view = 88 * pi / 180;
constexpr double filter_tolerance =
    3e-3;  // of the mean: far below what lobes miss, and a fraction of the time

void check(const LobeStackOptions& options) {
  if (options.views < 2 || options.views > 128)
    throw Error(fmt::format("the views of a stack must lie in [2, 128], not {}", options.views));
  if (options.largest_size < 4 || options.largest_size > 1024)
    throw Error(
        fmt::format("the largest size of a stack must lie in [4, 1024], not {}", options.largest_size));
}

// Steps that fall to a third towards grazing, where albedo and axis change fastest.
std::vector<double> view_row(int views) {
  std::vector<double> angles;
  for (int i = 0; i < views; ++i) {
    const double t = static_cast<double>(i) / (views - 1);
    angles.push_back(last_view * t * (3 - t) / 2);
  }
  return angles;
}

ZonalKernel kernel_of(const FittedLobe& lobe, LobeFamily family, const std::vector<double>& angles) {
  if (family == LobeFamily::ggx) return make_ggx_kernel(lobe.parameter);
  if (family == LobeFamily::phong) return make_phong_kernel(lobe.parameter);
  return make_table_kernel(make_kernel_table(angles, lobe.values));
}

// The angle at which a kernel has fallen to half of its largest value, from the outside.
double half_width(const FittedLobe& lobe, const std::vector<double>& angles) {
  const double half = *std::max_element(lobe.values.begin(), lobe.values.end()) / 2;
  std::size_t last = lobe.values.size() - 1;
  while (last > 1 && lobe.values[last] < half) --last;
  return angles[last];
}

// Six texels in the half width.
int size_for(double width, int largest) {
  int size = 4;
  while (size < largest && size * width < 6 * pi / 2) size *= 2;
  return std::min(size, largest);
}

LobeStack prepare(const Image& radiance, const IsotropicBrdf& brdf, const LobeStackOptions& options,
                  bool single) {
  check(options);
  LobeStack stack{single ? "single-lobe" : "lobes",
                  brdf.name,
                  options.target,
                  options.lobes,
                  view_row(options.views),
                  {},
                  {},
                  {}};
  const LobeFitOptions fit_options{options.lobes, options.family, options.target};
  const auto fits = single ? fit_single_lobe(brdf, stack.view_angles, fit_options)
                           : fit_lobes(brdf, stack.view_angles, fit_options);
  const std::vector<double> angles = lobe_angles(brdf);
  std::vector<FilterTarget> targets;
  for (const LobeFit& fit : fits) {
    stack.fit_errors.push_back(fit.relative_error);
    for (const FittedLobe& lobe : fit.lobes) {
      if (!single || targets.empty())
        targets.push_back({kernel_of(lobe, options.family, angles),
                           size_for(half_width(lobe, angles), options.largest_size)});
      stack.slots.push_back({lobe.axis, lobe.energy, static_cast<int>(targets.size()) - 1});
    }
  }
  stack.cubes = filter_environment(radiance, targets, {.tolerance = filter_tolerance, .progress = {}});
  return stack;
}

// The views on both sides of an angle and the share of the second.
struct Between {
  std::size_t first = 0, second = 0;
  double share = 0;
};

Between between_views(const std::vector<double>& angles, double angle) {
  const auto after = std::upper_bound(angles.begin(), angles.end(), angle);
  if (after == angles.end()) return {angles.size() - 1, angles.size() - 1, 0};
  const std::size_t second = std::max<std::ptrdiff_t>(1, after - angles.begin()), first = second - 1;
  return {first, second, (angle - angles[first]) / (angles[second] - angles[first])};
}

void add_lobe(const LobeStack& stack, const StackLobe& slot, double weight, Vec3 direction,
              std::array<double, 3>& sum) {
  float filtered[3];
  look_up_cube(stack.cubes[slot.cube], direction, filtered);
  for (int c = 0; c < 3; ++c) sum[c] += weight * slot.energy[c] * static_cast<double>(filtered[c]);
}

std::string slots_json(const LobeStack& stack, std::size_t view) {
  std::string text;
  for (int j = 0; j < stack.lobes; ++j) {
    const StackLobe& slot = stack.slots[view * stack.lobes + j];
    text +=
        fmt::format("{}{{\"axis\": {:.6f}, \"energy\": [{:.6g}, {:.6g}, {:.6g}], \"cube\": {}}}",
                    j > 0 ? ", " : "", slot.axis, slot.energy[0], slot.energy[1], slot.energy[2], slot.cube);
  }
  return text;
}

}  // namespace

LobeStack prepare_lobe_stack(const Image& radiance, const IsotropicBrdf& brdf,
                             const LobeStackOptions& options) {
  return prepare(radiance, brdf, options, false);
}

LobeStack prepare_single_lobe(const Image& radiance, const IsotropicBrdf& brdf,
                              const LobeStackOptions& options) {
  return prepare(radiance, brdf, options, true);
}

std::array<double, 3> reflect(const LobeStack& stack, const ReflectionQuery& query) {
  std::array<double, 3> sum{};
  const double cos_view = dot(query.normal, query.view);
  if (cos_view <= 0) return sum;
  const Vec3 towards_view = query.view - cos_view * query.normal;
  const double sine = length(towards_view);
  const Vec3 away = sine > 1e-12 ? (-1 / sine) * towards_view : Vec3{};
  const Between views = between_views(stack.view_angles, std::atan2(sine, cos_view));
  for (int j = 0; j < stack.lobes; ++j) {
    const StackLobe &a = stack.slots[views.first * stack.lobes + j],
                    &b = stack.slots[views.second * stack.lobes + j];
    const double axis = a.axis + views.share * (b.axis - a.axis);
    const Vec3 direction = std::cos(axis) * query.normal + std::sin(axis) * away;
    const double cosine = stack.target == LobeTarget::brdf ? std::max(0.0, std::cos(axis)) : 1;
    add_lobe(stack, a, cosine * (1 - views.share), direction, sum);
    add_lobe(stack, b, cosine * views.share, direction, sum);
  }
  return sum;
}

StackFiles stack_files(const LobeStack& stack) {
  StackFiles files;
  for (std::size_t i = 0; i < stack.cubes.size(); ++i)
    files.cubes.push_back({fmt::format("lobe{:03}", i), {{stack.cubes[i]}}});
  std::string views;
  for (std::size_t i = 0; i < stack.view_angles.size(); ++i)
    views += fmt::format("{}\n    {{\"angle\": {:.6f}, \"fit_error\": {:.4g}, \"lobes\": [{}]}}",
                         i > 0 ? "," : "", stack.view_angles[i], stack.fit_errors[i], slots_json(stack, i));
  files.json = fmt::format(
      "{{\n  \"method\": {},\n  \"brdf\": {},\n  \"cosine\": \"{}\",\n  \"views\": [{}\n  ],\n  \"lookup\": "
      "{}\n}}\n",
      json_string(stack.method), json_string(stack.brdf),
      stack.target == LobeTarget::brdf ? "n.axis, in the lookup" : "in the cubes", views,
      json_string(
          "between two views: axis, energy times cube linear in the angle (rad) of the view from the normal; "
          "the axis turns from the normal away from the view"));
  return files;
}

}  // namespace welkin
