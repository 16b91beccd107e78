#include <welkin/envmap/kernel_spec.h>

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <numbers>
#include <utility>

#include <welkin/error.h>

namespace welkin {
namespace {

double parse_parameter(std::string_view spec, std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error(fmt::format("kernel {}: \"{}\" is not a number", spec, text));
  return number;
}

double parse_angle(std::string_view spec, std::string_view text) {
  constexpr std::string_view degrees = "deg";
  if (!text.ends_with(degrees)) return parse_parameter(spec, text);
  text.remove_suffix(degrees.size());
  return parse_parameter(spec, text) * std::numbers::pi / 180;
}

}  // namespace

std::string kernel_spec_help() {
  return "ggx:ALPHA, phong:N, blinn-phong:N, gaussian:SIGMA (radians, or 5deg), vmf:KAPPA, lambert, "
         "table:FILE (lines of "
         "angle in degrees and value)";
}

ZonalKernel parse_kernel(std::string_view spec) {
  const std::size_t colon = spec.find(':');
  const std::string_view name = spec.substr(0, colon);
  const std::string_view text = colon == std::string_view::npos ? "" : spec.substr(colon + 1);
  if (spec == "lambert") return make_lambert_kernel();
  if (!text.empty()) {
    if (name == "ggx") return make_ggx_kernel(parse_parameter(spec, text));
    if (name == "phong") return make_phong_kernel(parse_parameter(spec, text));
    if (name == "blinn-phong") return make_blinn_phong_kernel(parse_parameter(spec, text));
    if (name == "gaussian") return make_gaussian_kernel(parse_angle(spec, text));
    if (name == "vmf") return make_von_mises_fisher_kernel(parse_parameter(spec, text));
    if (name == "table") return make_table_kernel(load_kernel_table(text));
  }
  throw Error(fmt::format("unknown kernel \"{}\"; choose one of {}", spec, kernel_spec_help()));
}

KernelKind parse_kernel_family(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, KernelKind>, 5> families{
      {{"ggx", KernelKind::ggx},
       {"phong", KernelKind::phong},
       {"blinn-phong", KernelKind::blinn_phong},
       {"gaussian", KernelKind::gaussian},
       {"vmf", KernelKind::von_mises_fisher}}};
  for (const auto& family : families)
    if (family.first == name) return family.second;
  throw Error(fmt::format("unknown kernel \"{}\"; choose ggx, phong, blinn-phong, gaussian or vmf", name));
}

}  // namespace welkin
