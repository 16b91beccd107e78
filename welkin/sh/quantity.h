#pragma once
#include <string_view>

#include <welkin/sh/projection.h>

namespace welkin {

/// Which function on the sphere some coefficients describe: radiance L, irradiance E, or E / pi.
enum class ShQuantity { radiance, irradiance, irradiance_over_pi };

/// "radiance", "irradiance" or "irradiance-over-pi".
std::string_view sh_quantity_name(ShQuantity quantity);

/// The quantity of that name. Throws Error for another name.
ShQuantity parse_sh_quantity(std::string_view name);

/// Coefficients of the quantity from those of the radiance.
ShCoefficients sh_of_quantity(const ShCoefficients& radiance, ShQuantity quantity);

/// The reverse: coefficients of the radiance from those of the quantity. Irradiance holds nothing of the degrees 3, 5,
/// 7, ..., so anything but radiance can only be turned back up to degree 2; throws Error beyond.
ShCoefficients sh_radiance_from(const ShCoefficients& coefficients, ShQuantity quantity);

}  // namespace welkin
