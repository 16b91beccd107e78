#include "sh_json.h"

#include <fmt/format.h>

#include <numbers>

#include "json_text.h"

#include <welkin/error.h>
#include <welkin/sh/convolution.h>

namespace welkin {

ShQuantity parse_sh_quantity(const std::string& name) {
  for (ShQuantity quantity : {ShQuantity::radiance, ShQuantity::irradiance, ShQuantity::irradiance_over_pi})
    if (name == sh_quantity_name(quantity)) return quantity;
  throw Error("unknown quantity '" + name + "'; choose radiance, irradiance or irradiance-over-pi");
}

std::string sh_quantity_name(ShQuantity quantity) {
  switch (quantity) {
    case ShQuantity::irradiance: return "irradiance";
    case ShQuantity::irradiance_over_pi: return "irradiance-over-pi";
    default: return "radiance";
  }
}

ShCoefficients sh_of_quantity(const ShCoefficients& radiance, ShQuantity quantity) {
  if (quantity == ShQuantity::radiance) return radiance;
  std::vector<double> factors = cosine_lobe(radiance.max_degree);
  if (quantity == ShQuantity::irradiance_over_pi)
    for (double& factor : factors) factor /= std::numbers::pi;
  return convolve(radiance, factors);
}

nlohmann::ordered_json sh_to_json(const ShCoefficients& coefficients, ShQuantity quantity,
                                  const std::string& source) {
  nlohmann::ordered_json json;
  json["generator"] = "welkin 0.1.0";
  json["source"] = source;
  json["quantity"] = sh_quantity_name(quantity);
  json["max_degree"] = coefficients.max_degree;
  json["convention"] = {
      {"basis", "real, orthonormal over the sphere"},
      {"condon_shortley_sign", false},
      {"index", "l (l + 1) + m"},
      {"first_functions", "Y_00 = 0.282095, Y_1-1 = 0.488603 y, Y_10 = 0.488603 z, Y_11 = 0.488603 x"},
      {"polar_axis", "z"},
      {"frame",
       "right-handed, +Y up, -Z forward; the middle column of an equirectangular map looks along +X"},
      {"cosine_applied", quantity != ShQuantity::radiance},
      {"one_over_pi_applied", quantity == ShQuantity::irradiance_over_pi},
      {"basis_constants_applied", false},
      {"window", "none"},
      {"evaluate",
       sh_quantity_name(quantity) + "(n) = sum over l, m of coefficient[l (l + 1) + m] * Y_lm(n)"}};
  json["color"] = "linear Rec. 709, [red, green, blue]";
  auto& rows = json["coefficients"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < coefficients.values.size(); i += coefficients.channels)
    rows.push_back({coefficients.values[i], coefficients.values[i + 1], coefficients.values[i + 2]});
  return json;
}

std::string sh_json_text(const nlohmann::ordered_json& json) {
  nlohmann::ordered_json head = json;
  head.erase("coefficients");
  std::string text = json_text(head);
  text.resize(text.rfind('\n'));
  text += ",\n  \"coefficients\": [\n";
  const auto& rows = json["coefficients"];
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += fmt::format("    [{:.9g}, {:.9g}, {:.9g}]{}\n", rows[i][0].get<double>(),
                        rows[i][1].get<double>(), rows[i][2].get<double>(), i + 1 < rows.size() ? "," : "");
  return text + "  ]\n}\n";
}

}  // namespace welkin
