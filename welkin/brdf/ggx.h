#pragma once

// The GGX microfacet model: distribution (Walter et al. 2007), Smith shadowing (Heitz 2014), Fresnel terms,
// and sampling of visible normals (Heitz 2018). Everything is isotropic and in the local shading frame: z is
// the surface normal, cosines are z components. `alpha` is the GGX width, in (0, 1] in practice (alpha =
// perceptual_roughness^2).
//
// A mirror-like microfacet reflection is f = F D G2 / (4 cos_view cos_light), per steradian; with the
// visibility term, f = F D V.

namespace welkin {

/// A direction in the local shading frame; z is along the surface normal.
struct LocalVec {
  double x = 0, y = 0, z = 1;
};

constexpr double dot(LocalVec a, LocalVec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// `direction` mirrored about the unit vector `axis`: 2 (axis . direction) axis - direction.
constexpr LocalVec reflected(LocalVec direction, LocalVec axis) {
  const double twice = 2 * dot(direction, axis);
  return {twice * axis.x - direction.x, twice * axis.y - direction.y, twice * axis.z - direction.z};
}

/// Density of microfacet normals D, per steradian (Walter et al. 2007, eq. 33): D integrated with the cosine
/// over the hemisphere gives 1. Zero for cos_half <= 0.
double ggx_distribution(double cos_half, double alpha);

/// Smith's auxiliary function Lambda, >= 0 (Heitz 2014, eq. 72). Precondition: 0 < cosine <= 1.
double ggx_lambda(double cosine, double alpha);

/// Masking of one direction, G1 = 1 / (1 + Lambda), in [0, 1] (Heitz 2014, eq. 43). Zero for cosine <= 0.
double ggx_masking(double cosine, double alpha);

/// Height-correlated masking and shadowing, G2 = 1 / (1 + Lambda(view) + Lambda(light)), in [0, 1] (Heitz
/// 2014, eq. 99). Zero where either cosine is <= 0.
double ggx_masking_shadowing(double cos_view, double cos_light, double alpha);

/// V = G2 / (4 cos_view cos_light), finite at grazing angles when alpha > 0. Zero where either cosine is <=
/// 0.
double ggx_visibility(double cos_view, double cos_light, double alpha);

/// Schlick 1994: f0 + (f90 - f0) (1 - cosine)^5, with the cosine between the direction and the microfacet
/// normal.
double fresnel_schlick(double cosine, double f0, double f90 = 1);

/// Unpolarised reflectance of a smooth dielectric for light that arrives at `cosine` in [0, 1]. `eta` is the
/// index beyond the surface over the index on the side of the light (1.5 from air into glass); 1 at total
/// reflection.
double fresnel_dielectric(double cosine, double eta);

/// Unpolarised reflectance of a smooth conductor with the complex index eta + i k, seen from vacuum.
double fresnel_conductor(double cosine, double eta, double k);

/// The microfacet normal, unit length and facing `view`, that the uniform numbers u1, u2 in [0, 1) give
/// (Heitz 2018, listing 1). `view` is unit length with view.z > 0. Distributed as ggx_visible_normal_pdf.
LocalVec sample_ggx_visible_normal(LocalVec view, double alpha, double u1, double u2);

/// Density of visible normals, per steradian of the normal: G1(view) max(0, view . normal) D(normal) /
/// view.z. The mirrored light direction has this density over 4 (view . normal), per steradian.
double ggx_visible_normal_pdf(LocalVec view, LocalVec normal, double alpha);

}  // namespace welkin
