#pragma once
#include <array>
#include <optional>
#include <string_view>

#include <welkin/brdf/fresnel_blend.h>
#include <welkin/brdf/isotropic.h>

namespace welkin {

/// A BRDF from its text form; the models are those of models.h and merl.h:
///   lambert:ALBEDO               ggx:ALPHA[,F0]               merl:FILE
///   phong:N[,SCALE]              ggx-dielectric:ALPHA,ETA
///   blinn-phong:N[,SCALE]        ggx-conductor:ALPHA,ETA,K
///   ward:ALPHA[,SPECULAR]        lafortune:CX:CY:CZ:N[:SCALE],...[,diffuse:ALBEDO]   (CX = CY; see lafortune.h)
///   fresnel-blend:N,ALBEDO,ETA[,K]                 fresnel-blend-schlick:N,ALBEDO,F0
/// F0 is 0.04 and the other scales 1 unless given; ALBEDO, SCALE, SPECULAR, F0, ETA and K of a conductor may be three
/// numbers, R:G:B. Throws Error that names the choices for an unknown model, and that says which parameter is missing,
/// superfluous, no number or out of range.
IsotropicBrdf parse_brdf(std::string_view spec);

/// The parameters of "ggx:ALPHA[,F0]", for methods that are made for this model.
struct GgxParameters {
  double alpha = 0;
  std::array<double, 3> f0{};
};

/// Nothing for another model; throws Error where parse_brdf does.
std::optional<GgxParameters> parse_ggx_spec(std::string_view spec);
std::optional<FresnelBlendMaterial> parse_fresnel_blend_spec(std::string_view spec);

/// "lambert:ALBEDO, phong:N[,SCALE], ...": the choices, for help texts.
std::string_view brdf_choices();

}  // namespace welkin
