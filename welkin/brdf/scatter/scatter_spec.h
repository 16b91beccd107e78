#pragma once
#include <memory>
#include <string_view>

#include <welkin/brdf/scatter/energy_table.h>
#include <welkin/brdf/scatter/scatter.h>

namespace welkin {

/// A Scatter and what it points to.
struct OwnedScatter {
  Scatter scatter;
  std::shared_ptr<const EnergyTable> energy;  ///< null where none is needed
};

/// A BRDF for Monte Carlo from its text form:
///   lambert:ALBEDO                        ggx:ALPHA[,F0]
///   oren-nayar:SIGMA,ALBEDO (radians)     ggx-conductor:ALPHA,ETA,K
///   phong:N[,SCALE]                       coated-diffuse:ALPHA,ALBEDO[,F0]  (ALPHA 0: a smooth coat)
///   blinn-phong:N[,SCALE]                 metallic-roughness:ALPHA,COLOR,METALLIC[,F0]
///   lafortune:CX:CY:CZ:N[,SCALE]          mirror[:COLOR], conductor:ETA,K, dielectric:ETA
/// ALPHA may be two numbers, X:Y (anisotropic; not of a coat); colours, ETA and K three, R:G:B. Scales are 1 and F0 is
/// 0.04 unless given, of ggx as in brdf_spec.h. A last parameter "compensated" gives back what glossy lobes lose.
/// Throws Error that names the choices for an unknown model, and what is wrong with a parameter.
OwnedScatter parse_scatter(std::string_view spec);

/// "lambert:ALBEDO, oren-nayar:SIGMA,ALBEDO, ...": the choices, for help texts.
std::string_view scatter_choices();

}  // namespace welkin
