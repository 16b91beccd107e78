#pragma once
#include <array>

#include <welkin/brdf/isotropic.h>

namespace welkin {

/// Which law the reflectance of a smooth surface follows with the cosine of the angle of incidence; a number a channel.
struct FresnelLaw {
  enum class Kind { schlick, dielectric, conductor };
  Kind kind = Kind::schlick;
  std::array<double, 3> f0 = {0.04, 0.04, 0.04};  ///< schlick: at normal incidence, in [0, 1]
  std::array<double, 3> eta = {1.5, 1.5, 1.5};    ///< dielectric, conductor: index, in [0.01, 20]
  std::array<double, 3> k{};                      ///< conductor: absorption, in [0, 20]
};

/// In [0, 1] a channel; cosine in [0, 1].
std::array<double, 3> reflectance(const FresnelLaw& law, double cosine);

/// A diffuse base under a glossy coat, in balance by Fresnel (as in the SIGGRAPH 2006 course on environment maps):
///   (1 - F) albedo / pi + F (N + 1) / (2 pi) cos^N(angle of the light from the mirrored view) / cos_light.
/// The second term is Phong's reflection as he stated it, for light that is not foreshortened, which alone makes
/// prefiltered maps of two dimensions possible; not reciprocal.
struct FresnelBlendMaterial {
  std::array<double, 3> albedo = {0.5, 0.5, 0.5};  ///< in [0, 1]
  double exponent = 100;                           ///< N, in [0, 1e6]
  FresnelLaw fresnel;
};

/// The material with F at the half vector of view and light, where it belongs: the truth that the maps are measured
/// against. Throws Error for parameters out of range.
IsotropicBrdf make_fresnel_blend_brdf(const FresnelBlendMaterial& material);

/// Throws Error that names the first parameter out of range.
void check_fresnel_blend(const FresnelBlendMaterial& material);

}  // namespace welkin
