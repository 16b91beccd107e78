#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <welkin/envmap/filter.h>
#include <welkin/envmap/methods/angular.h>
#include <welkin/envmap/methods/bordered.h>
#include <welkin/envmap/methods/box.h>
#include <welkin/envmap/methods/brute.h>
#include <welkin/envmap/methods/frequency.h>
#include <welkin/envmap/methods/hierarchical.h>
#include <welkin/envmap/methods/importance.h>
#include <welkin/envmap/methods/paraboloid.h>
#include <welkin/envmap/methods/quick.h>

// The filters of the literature under their names, to be compared. Each is one pair of files; its header says its paper,
// its artefact and its error. docs/filters.md has them all in one table of time and error.

namespace welkin {

enum class FilterMethod {
  brute,
  hierarchical,
  angular,
  bordered,
  box,
  paraboloid,
  importance,
  quick,
  frequency
};

/// The methods, in the order of the enumeration.
const std::vector<FilterMethod>& filter_methods();

/// "brute", "frequency" and so on.
std::string_view filter_method_name(FilterMethod method);

/// The method of that name. Throws Error listing the names.
FilterMethod parse_filter_method(std::string_view name);

/// Each method reads its own part.
struct FilterMethodOptions {
  BruteOptions brute{};
  HierarchicalOptions hierarchical{};
  AngularOptions angular{};
  BorderedOptions bordered{};
  BoxOptions box{};
  ParaboloidOptions paraboloid{};
  ImportanceOptions importance{};
  QuickOptions quick{};
  FrequencyOptions frequency{};
};

/// One filtered cube by the method: texel = scale * integral of K(angle to texel centre) * radiance, as well as the
/// method can. radiance: equirectangular, 3 channels, finite and >= 0. Throws Error for a size outside 1 to 8192 and for options
/// out of their range. Same bits on any number of threads.
Cube filter_by_method(const Image& radiance, const FilterTarget& target,
                      FilterMethod method = FilterMethod::frequency, const FilterMethodOptions& options = {});

}  // namespace welkin
