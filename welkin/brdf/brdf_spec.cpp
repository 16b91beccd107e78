#include <welkin/brdf/brdf_spec.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <welkin/brdf/lafortune.h>
#include <welkin/brdf/merl.h>
#include <welkin/brdf/models.h>
#include <welkin/brdf/spec_parameters.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>

namespace welkin {
namespace {

using Rgb = std::array<double, 3>;
using Parameters = SpecParameters;

IsotropicBrdf lambert(Parameters& p) { return make_lambert_brdf(p.colour()); }

IsotropicBrdf phong(Parameters& p) {
  const double exponent = p.number();
  return make_phong_brdf(exponent, p.colour_or(1));
}

IsotropicBrdf blinn_phong(Parameters& p) {
  const double exponent = p.number();
  return make_blinn_phong_brdf(exponent, p.colour_or(1));
}

GgxParameters ggx_parameters(Parameters& p) {
  const double alpha = p.number();
  return {alpha, p.colour_or(0.04)};
}

IsotropicBrdf ggx(Parameters& p) {
  const GgxParameters parameters = ggx_parameters(p);
  return make_ggx_brdf(parameters.alpha, parameters.f0);
}

IsotropicBrdf ggx_dielectric(Parameters& p) {
  const double alpha = p.number();
  return make_ggx_dielectric_brdf(alpha, p.number());
}

IsotropicBrdf ggx_conductor(Parameters& p) {
  const double alpha = p.number();
  const Rgb eta = p.colour();
  return make_ggx_conductor_brdf(alpha, eta, p.colour());
}

IsotropicBrdf ward(Parameters& p) {
  const double alpha = p.number();
  return make_ward_brdf(alpha, p.colour_or(1));
}

// A conductor where k is given, else a dielectric.
FresnelBlendMaterial fresnel_material(Parameters& p) {
  FresnelBlendMaterial material;
  material.exponent = p.number();
  material.albedo = p.colour();
  material.fresnel.eta = p.colour();
  material.fresnel.kind = p.more() ? FresnelLaw::Kind::conductor : FresnelLaw::Kind::dielectric;
  material.fresnel.k = p.colour_or(0);
  return material;
}

FresnelBlendMaterial schlick_material(Parameters& p) {
  FresnelBlendMaterial material;
  material.exponent = p.number();
  material.albedo = p.colour();
  material.fresnel.f0 = p.colour();
  return material;
}

IsotropicBrdf fresnel_blend(Parameters& p) { return make_fresnel_blend_brdf(fresnel_material(p)); }
IsotropicBrdf fresnel_blend_schlick(Parameters& p) { return make_fresnel_blend_brdf(schlick_material(p)); }

struct Model {
  std::string_view name, form;
  IsotropicBrdf (*make)(Parameters&);
};

constexpr std::array<Model, 9> models{{
    {"lambert", "lambert:ALBEDO", lambert},
    {"phong", "phong:N[,SCALE]", phong},
    {"blinn-phong", "blinn-phong:N[,SCALE]", blinn_phong},
    {"ggx", "ggx:ALPHA[,F0]", ggx},
    {"ggx-dielectric", "ggx-dielectric:ALPHA,ETA", ggx_dielectric},
    {"ggx-conductor", "ggx-conductor:ALPHA,ETA,K", ggx_conductor},
    {"ward", "ward:ALPHA[,SPECULAR]", ward},
    {"fresnel-blend", "fresnel-blend:N,ALBEDO,ETA[,K]", fresnel_blend},
    {"fresnel-blend-schlick", "fresnel-blend-schlick:N,ALBEDO,F0", fresnel_blend_schlick},
}};

IsotropicBrdf read_measured(std::string_view file) {
  if (file.empty()) throw Error("BRDF 'merl:': the file is missing; its form is merl:FILE");
  return make_merl_brdf(read_merl(read_file(std::string(file)), file), file);
}

}  // namespace

IsotropicBrdf parse_brdf(std::string_view spec) {
  const std::size_t colon = std::min(spec.find(':'), spec.size());
  const std::string_view name = spec.substr(0, colon);
  const std::string_view rest = spec.substr(std::min(colon + 1, spec.size()));
  if (name == "merl") return read_measured(rest);
  if (name == "lafortune") return make_lafortune_brdf(parse_lafortune(rest));
  for (const Model& model : models) {
    if (model.name != name) continue;
    Parameters parameters(spec, model.form, rest);
    IsotropicBrdf brdf = model.make(parameters);
    parameters.finish();
    return brdf;
  }
  throw Error(fmt::format("unknown BRDF '{}'; valid are {}", spec, brdf_choices()));
}

namespace {

std::string_view name_of(std::string_view spec) {
  return spec.substr(0, std::min(spec.find(':'), spec.size()));
}

// The parameters as one model reads them, when the spec is of that model.
template <class Read>
auto read_as(std::string_view model, std::string_view spec, Read read)
    -> std::optional<decltype(read(std::declval<Parameters&>()))> {
  if (name_of(spec) != model) return {};
  parse_brdf(spec);  // which checks it
  Parameters parameters(spec, model, spec.substr(model.size() + 1));
  return read(parameters);
}

}  // namespace

std::optional<GgxParameters> parse_ggx_spec(std::string_view spec) {
  return read_as("ggx", spec, ggx_parameters);
}

std::optional<FresnelBlendMaterial> parse_fresnel_blend_spec(std::string_view spec) {
  if (auto material = read_as("fresnel-blend", spec, fresnel_material)) return material;
  return read_as("fresnel-blend-schlick", spec, schlick_material);
}

std::string_view brdf_choices() {
  static const std::string choices = [] {
    std::string text;
    for (const Model& model : models) text += fmt::format("{}, ", model.form);
    return text + "lafortune:CX:CY:CZ:N[:SCALE],...[,diffuse:ALBEDO], merl:FILE";
  }();
  return choices;
}

}  // namespace welkin
