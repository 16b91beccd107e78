#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/brdf/ggx.h>
#include <welkin/brdf/isotropic.h>

namespace welkin {

/// One lobe of Lafortune et al. 1997, eq. 6: a power of a weighted dot product in the frame of the surface (z = normal,
/// x = tangent),
///   scale (N + 2) / (2 pi) max(0, Cx lx vx + Cy ly vy + Cz lz vz)^N.
/// (-1, -1, 1) is Phong's lobe about the mirror direction, with the factor that make_phong_brdf has; |Cx| = |Cy| > Cz
/// bends it towards the horizon (off-specular), positive Cx, Cy reflect back, Cx != Cy is anisotropic.
struct LafortuneLobe {
  double cx = -1, cy = -1, cz = 1;
  double exponent = 1;
  std::array<double, 3> scale = {1, 1, 1};

  /// (Cx vx, Cy vy, Cz vz): where the lobe for this view points, not of unit length.
  LocalVec axis(LocalVec view) const { return {cx * view.x, cy * view.y, cz * view.z}; }
};

/// Several lobes over a diffuse floor. Reciprocal. Reflects at most diffuse + the scales where no |C| is above 1; with
/// larger ones (published fits have them) it may reflect more than arrives.
struct LafortuneBrdf {
  std::array<double, 3> diffuse_albedo = {0, 0, 0};
  std::vector<LafortuneLobe> lobes;
};

/// The BRDF, per steradian, for unit vectors in the frame of the surface; 0 where either z is <= 0.
std::array<double, 3> evaluate(const LafortuneBrdf& brdf, LocalVec light, LocalVec view);

/// Whether turning light and view about the normal together changes nothing: every lobe has Cx = Cy.
bool is_isotropic(const LafortuneBrdf& brdf);

/// The same as an IsotropicBrdf. Throws Error where it is not isotropic.
IsotropicBrdf make_lafortune_brdf(const LafortuneBrdf& brdf);

/// From the text "CX:CY:CZ:N[:SCALE or :R:G:B],...[,diffuse:ALBEDO or :R:G:B]", as it follows "lafortune:" (which may
/// stand before it). N in [0, 1e5], |C| <= 2 with |C|^N <= 1e6, scales in [0, 100], albedo in [0, 1], 1 to 16 lobes.
/// Throws Error that says what is wrong.
LafortuneBrdf parse_lafortune(std::string_view text);

/// "lafortune, 2 lobes, N 20 to 100".
std::string describe(const LafortuneBrdf& brdf);

}  // namespace welkin
