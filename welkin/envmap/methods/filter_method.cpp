#include <welkin/envmap/methods/filter_method.h>

#include <algorithm>
#include <cassert>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr int max_size = 8192;

using Filter = Cube (*)(const Image&, const FilterTarget&, const FilterMethodOptions&);

struct Entry {
  FilterMethod method;
  std::string_view name;
  Filter filter;
};

// A method's function with its own part of the options.
template <auto function, auto part>
Cube call(const Image& radiance, const FilterTarget& target, const FilterMethodOptions& options) {
  return function(radiance, target, options.*part);
}

using M = FilterMethod;
using O = FilterMethodOptions;

constexpr Entry entries[] = {
    {M::brute, "brute", call<filter_brute, &O::brute>},
    {M::hierarchical, "hierarchical", call<filter_hierarchical, &O::hierarchical>},
    {M::angular, "angular", call<filter_angular, &O::angular>},
    {M::bordered, "bordered", call<filter_bordered, &O::bordered>},
    {M::box, "box", call<filter_box, &O::box>},
    {M::paraboloid, "paraboloid", call<filter_paraboloid, &O::paraboloid>},
    {M::importance, "importance", call<filter_importance, &O::importance>},
    {M::quick, "quick", call<filter_quick, &O::quick>},
    {M::frequency, "frequency", call<filter_frequency, &O::frequency>},
};

const Entry& entry_of(FilterMethod method) {
  const Entry* found = std::find_if(std::begin(entries), std::end(entries),
                                    [&](const Entry& e) { return e.method == method; });
  assert(found != std::end(entries));
  return *found;
}

}  // namespace

const std::vector<FilterMethod>& filter_methods() {
  static const std::vector<FilterMethod> methods = [] {
    std::vector<FilterMethod> all;
    for (const Entry& entry : entries) all.push_back(entry.method);
    return all;
  }();
  return methods;
}

std::string_view filter_method_name(FilterMethod method) { return entry_of(method).name; }

FilterMethod parse_filter_method(std::string_view name) {
  std::string names;
  for (const Entry& entry : entries) {
    if (entry.name == name) return entry.method;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw Error("unknown method \"" + std::string(name) + "\": " + names);
}

Cube filter_by_method(const Image& radiance, const FilterTarget& target, FilterMethod method,
                      const FilterMethodOptions& options) {
  assert(radiance.channels == 3 && !radiance.empty());
  if (target.size < 1 || target.size > max_size)
    throw Error("a filtered cube of size " + std::to_string(target.size) + ": 1 to " +
                std::to_string(max_size));
  return entry_of(method).filter(radiance, target, options);
}

}  // namespace welkin
