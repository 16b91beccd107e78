#pragma once
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/brdf/isotropic.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>

namespace welkin {

/// What every method of `welkin reflect` starts from.
struct ReflectInput {
  const Image& radiance;  ///< equirectangular
  std::string brdf_spec;  ///< as the user wrote it
  IsotropicBrdf brdf;
  double error_bound = 0.02;  ///< relative RMS, for methods that choose their size by it
};

/// A method with all that it computes beforehand done.
struct PreparedReflection {
  std::function<std::array<double, 3>(const ReflectionQuery&)> reflect;
  std::string note;  ///< what was prepared, for the report: "9 elevations, 2 lobes"
};

struct ReflectMethod {
  std::string_view name, what;
  /// Throws Error where the method cannot do this BRDF.
  PreparedReflection (*prepare)(const ReflectInput& input);
};

/// Every method but brute force, the oracle.
const std::vector<ReflectMethod>& reflect_methods();

/// The method of this name; throws Error naming the choices.
const ReflectMethod& find_reflect_method(std::string_view name);

}  // namespace welkin
