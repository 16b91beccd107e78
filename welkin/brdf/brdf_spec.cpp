#include <welkin/brdf/brdf_spec.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <welkin/brdf/lafortune.h>
#include <welkin/brdf/merl.h>
#include <welkin/brdf/models.h>
#include <welkin/brdf/spec_numbers.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>

namespace welkin {
namespace {

using Rgb = std::array<double, 3>;

// The parameters of one model, taken from first to last.
class Parameters {
 public:
  Parameters(std::string_view spec, std::string_view form, std::string_view text) : spec_(spec), form_(form) {
    if (!text.empty()) parts_ = split_spec(text, ',');
  }

  double number() { return parse(next()); }

  Rgb colour() {
    const std::vector<std::string_view> parts = split_spec(next(), ':');
    if (parts.size() == 1) {
      const double grey = parse(parts[0]);
      return {grey, grey, grey};
    }
    if (parts.size() != 3) refuse("a colour is one number or three (1:0.5:0.25)");
    return {parse(parts[0]), parse(parts[1]), parse(parts[2])};
  }

  Rgb colour_or(double grey) { return at_ < parts_.size() ? colour() : Rgb{grey, grey, grey}; }

  /// To be called when all that the model has were taken.
  void finish() const {
    if (at_ < parts_.size()) refuse("it has a parameter too many");
  }

 private:
  std::string_view next() {
    if (at_ >= parts_.size()) refuse("a parameter is missing");
    return parts_[at_++];
  }

  double parse(std::string_view text) const {
    const std::optional<double> value = spec_number(text);
    if (!value) refuse(fmt::format("'{}' is not a number", text));
    return *value;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(fmt::format("BRDF '{}': {}; its form is {}", spec_, what, form_));
  }

  std::string_view spec_, form_;
  std::vector<std::string_view> parts_;
  std::size_t at_ = 0;
};

IsotropicBrdf lambert(Parameters& p) { return make_lambert_brdf(p.colour()); }

IsotropicBrdf phong(Parameters& p) {
  const double exponent = p.number();
  return make_phong_brdf(exponent, p.colour_or(1));
}

IsotropicBrdf blinn_phong(Parameters& p) {
  const double exponent = p.number();
  return make_blinn_phong_brdf(exponent, p.colour_or(1));
}

IsotropicBrdf ggx(Parameters& p) {
  const double alpha = p.number();
  return make_ggx_brdf(alpha, p.colour_or(0.04));
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

struct Model {
  std::string_view name, form;
  IsotropicBrdf (*make)(Parameters&);
};

constexpr std::array<Model, 7> models{{
    {"lambert", "lambert:ALBEDO", lambert},
    {"phong", "phong:N[,SCALE]", phong},
    {"blinn-phong", "blinn-phong:N[,SCALE]", blinn_phong},
    {"ggx", "ggx:ALPHA[,F0]", ggx},
    {"ggx-dielectric", "ggx-dielectric:ALPHA,ETA", ggx_dielectric},
    {"ggx-conductor", "ggx-conductor:ALPHA,ETA,K", ggx_conductor},
    {"ward", "ward:ALPHA[,SPECULAR]", ward},
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

std::string_view brdf_choices() {
  static const std::string choices = [] {
    std::string text;
    for (const Model& model : models) text += fmt::format("{}, ", model.form);
    return text + "lafortune:CX:CY:CZ:N[:SCALE],...[,diffuse:ALBEDO], merl:FILE";
  }();
  return choices;
}

}  // namespace welkin
