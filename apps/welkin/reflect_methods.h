#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/brdf/isotropic.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/envmap/reflection/stack_files.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>

namespace welkin {

/// What every method of `welkin reflect` starts from.
struct ReflectInput {
  Image radiance;                              ///< equirectangular
  std::string brdf_spec;                       ///< as the user wrote it
  IsotropicBrdf brdf;                          ///< without a value where `anisotropic` is there
  std::optional<LafortuneBrdf> anisotropic{};  ///< lafortune:... with CX != CY
  double error_bound = 0.02;                   ///< relative RMS, for methods that choose their size by it
};

/// A method with all that it computes beforehand done.
struct PreparedReflection {
  std::function<std::array<double, 3>(const ReflectionQuery&)> reflect;
  std::string note;  ///< what was prepared, for the report: "9 elevations, 2 lobes"
  /// The same along the grain of a surface; empty for methods that have none.
  std::function<std::array<double, 3>(const TangentQuery&)> reflect_along{};
  std::function<StackFiles()> stack{};  ///< what a renderer needs of it; empty for methods that have no stack
};

struct ReflectMethod {
  std::string_view name, what;
  /// Throws Error where the method cannot do this BRDF.
  PreparedReflection (*prepare)(const ReflectInput& input);
  bool has_stack = false;
};

/// `method` made ready; throws Error where it cannot do this BRDF, as all but lafortune cannot do anisotropic ones.
PreparedReflection prepare(const ReflectMethod& method, const ReflectInput& input);

/// Every method but brute force, the oracle.
const std::vector<ReflectMethod>& reflect_methods();

/// The method of this name; throws Error naming the choices.
const ReflectMethod& find_reflect_method(std::string_view name);

}  // namespace welkin
