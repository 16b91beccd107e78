#include <welkin/brdf/scatter/scatter_spec.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

#include <welkin/brdf/spec_parameters.h>
#include <welkin/error.h>

namespace welkin {
namespace {

using Parameters = SpecParameters;

float in_range(const Parameters& p, const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    p.refuse(fmt::format("{} is {:g}; it must lie in [{:g}, {:g}]", what, value, low, high));
  return static_cast<float>(value);
}

Rgb in_range(const Parameters& p, const char* what, const std::array<double, 3>& v, double low, double high) {
  return {in_range(p, what, v[0], low, high), in_range(p, what, v[1], low, high),
          in_range(p, what, v[2], low, high)};
}

void read_alpha(Parameters& p, Scatter& s) {
  const std::vector<double> alpha = p.numbers();
  if (alpha.size() > 2) p.refuse("alpha is one number or two, X:Y");
  s.alpha_x = in_range(p, "alpha", alpha.front(), 1e-3, 1);
  s.alpha_y = in_range(p, "alpha", alpha.back(), 1e-3, 1);
}

void read_index(Parameters& p, Scatter& s) {
  s.eta = in_range(p, "eta", p.colour(), 0.01, 20);
  s.k = in_range(p, "k", p.colour(), 0, 20);
}

void read_color(Parameters& p, Scatter& s) { s.color = in_range(p, "colour", p.colour(), 0, 1); }

void read_power(Parameters& p, Scatter& s) {
  s.exponent = in_range(p, "exponent", p.number(), 0, 1e5);
  s.color = in_range(p, "scale", p.colour_or(1), 0, 1);
}

void read_oren_nayar(Parameters& p, Scatter& s) {
  s.sigma_radians = in_range(p, "sigma", p.number(), 0, std::numbers::pi / 2);
  read_color(p, s);
}

void read_lafortune(Parameters& p, Scatter& s) {
  const std::vector<double> lobe = p.numbers();
  if (lobe.size() != 4) p.refuse("the lobe is four numbers");
  for (std::size_t i = 0; i < 3; ++i) s.lafortune_c[i] = in_range(p, "C", lobe[i], -2, 2);
  s.exponent = in_range(p, "exponent", lobe[3], 0, 1e5);
  s.color = in_range(p, "scale", p.colour_or(1), 0, 100);
}

void read_ggx(Parameters& p, Scatter& s) {
  read_alpha(p, s);
  s.color = in_range(p, "f0", p.colour_or(0.04), 0, 1);
}

void read_ggx_conductor(Parameters& p, Scatter& s) {
  read_alpha(p, s);
  read_index(p, s);
}

void read_coated(Parameters& p, Scatter& s) {
  const double alpha = p.number();
  if (alpha != 0) in_range(p, "alpha", alpha, 1e-3, 1);
  s.alpha_x = s.alpha_y = static_cast<float>(alpha);
  read_color(p, s);
  if (p.more()) s.f0 = in_range(p, "f0", p.number(), 0, 1);
}

void read_metallic(Parameters& p, Scatter& s) {
  read_alpha(p, s);
  read_color(p, s);
  s.metallic = in_range(p, "metallic", p.number(), 0, 1);
  if (p.more()) s.f0 = in_range(p, "f0", p.number(), 0, 1);
}

void read_mirror(Parameters& p, Scatter& s) { s.color = in_range(p, "colour", p.colour_or(1), 0, 1); }

void read_dielectric(Parameters& p, Scatter& s) {
  const float eta = in_range(p, "eta", p.number(), 1, 10);
  s.eta = {eta, eta, eta};
}

struct Form {
  ScatterModel model;
  std::string_view text;
  void (*read)(Parameters&, Scatter&);
  bool compensable;
};

constexpr std::array<Form, 12> forms{{
    {ScatterModel::lambert, "lambert:ALBEDO", read_color, false},
    {ScatterModel::oren_nayar, "oren-nayar:SIGMA,ALBEDO", read_oren_nayar, false},
    {ScatterModel::phong, "phong:N[,SCALE][,compensated]", read_power, true},
    {ScatterModel::blinn_phong, "blinn-phong:N[,SCALE][,compensated]", read_power, true},
    {ScatterModel::lafortune, "lafortune:CX:CY:CZ:N[,SCALE][,compensated]", read_lafortune, true},
    {ScatterModel::ggx, "ggx:ALPHA[,F0][,compensated]", read_ggx, true},
    {ScatterModel::ggx_conductor, "ggx-conductor:ALPHA,ETA,K[,compensated]", read_ggx_conductor, true},
    {ScatterModel::mirror, "mirror[:COLOR]", read_mirror, false},
    {ScatterModel::conductor, "conductor:ETA,K", read_index, false},
    {ScatterModel::dielectric, "dielectric:ETA", read_dielectric, false},
    {ScatterModel::coated_diffuse, "coated-diffuse:ALPHA,ALBEDO[,F0][,compensated]", read_coated, true},
    {ScatterModel::metallic_roughness, "metallic-roughness:ALPHA,COLOR,METALLIC[,F0][,compensated]",
     read_metallic, true},
}};

}  // namespace

OwnedScatter parse_scatter(std::string_view spec) {
  const std::size_t colon = std::min(spec.find(':'), spec.size());
  for (const Form& form : forms) {
    if (scatter_model_name(form.model) != spec.substr(0, colon)) continue;
    Parameters parameters(spec, form.text, spec.substr(std::min(colon + 1, spec.size())));
    OwnedScatter owned;
    owned.scatter.model = form.model;
    owned.scatter.compensated = form.compensable && parameters.take_last("compensated");
    form.read(parameters, owned.scatter);
    parameters.finish();
    if (owned.scatter.compensated && needs_energy_table(owned.scatter)) {
      owned.energy = std::make_shared<const EnergyTable>(make_energy_table(owned.scatter));
      owned.scatter.energy = owned.energy.get();
    }
    return owned;
  }
  throw Error(fmt::format("unknown BRDF '{}'; those that can be sampled are {}", spec, scatter_choices()));
}

std::string_view scatter_choices() {
  static const std::string choices = [] {
    std::string text;
    for (const Form& form : forms) text += fmt::format("{}{}", text.empty() ? "" : "; ", form.text);
    return text;
  }();
  return choices;
}

}  // namespace welkin
