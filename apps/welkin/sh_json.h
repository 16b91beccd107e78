#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include <welkin/sh/projection.h>

namespace welkin {

/// Which function the coefficients describe.
enum class ShQuantity { radiance, irradiance, irradiance_over_pi };

ShQuantity parse_sh_quantity(const std::string& name);
std::string sh_quantity_name(ShQuantity quantity);

/// Coefficients of the quantity from those of the radiance.
ShCoefficients sh_of_quantity(const ShCoefficients& radiance, ShQuantity quantity);

/// The file format of `welkin sh --json` and of the set's sh.json: the coefficients with every convention named.
nlohmann::ordered_json sh_to_json(const ShCoefficients& coefficients, ShQuantity quantity,
                                  const std::string& source);

/// JSON text with one line per coefficient, so that files can be compared line by line.
std::string sh_json_text(const nlohmann::ordered_json& json);

}  // namespace welkin
