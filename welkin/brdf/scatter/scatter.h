#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include <welkin/geometry/vec3f.h>
#include <welkin/image/rgb.h>

// Reflection at a point, for Monte Carlo: every BRDF as evaluate / pdf / sample. Everything is in the local shading
// frame: z is the shading normal, x the tangent; light and view are unit length and point away from the surface. Single
// precision; the closed forms in double are in welkin/brdf/models.h and ggx.h.

namespace welkin {

struct EnergyTable;

/// Which BRDF a Scatter is. Parameters in brackets are those that it reads.
enum class ScatterModel : std::uint8_t {
  lambert,  ///< [color]: albedo
  oren_nayar,  ///< [color, sigma_radians]: rough diffuse facets (Oren & Nayar 1994, in an energy-preserving form)
  phong,       ///< [color, exponent]: as make_phong_brdf
  blinn_phong,    ///< [color, exponent]: as make_blinn_phong_brdf
  lafortune,      ///< [color = scale, exponent, lafortune_c]: one lobe, as LafortuneLobe
  ggx,            ///< [color = F0, f90, alpha_x, alpha_y]: metal with Schlick's term
  ggx_conductor,  ///< [eta, k, alpha_x, alpha_y]: metal with the exact term
  mirror,         ///< [color]: smooth, reflects color times the light
  conductor,      ///< [eta, k]: smooth metal
  dielectric,     ///< [eta.r]: smooth, reflects Fresnel's share; the rest is absorbed
  coated_diffuse,  ///< [color = albedo, f0, f90, alpha_x; 0: a smooth coat]: GGX coat over a diffuse base, lossless for white
  metallic_roughness,  ///< glTF 2.0: [color = base color, metallic, f0 and f90 of the dielectric part, alpha_x, alpha_y]
};

/// A BRDF at a point with its parameters: plain data, copied freely. Defaults are a gray Lambert surface.
struct Scatter {
  ScatterModel model = ScatterModel::lambert;
  bool compensated =
      false;  ///< glossy models: light lost between facets (or below the horizon) is given back
  Rgb color{0.5f, 0.5f, 0.5f};
  float f0 = 0.04f, f90 = 1;               ///< in [0, 1]
  float alpha_x = 0.25f, alpha_y = 0.25f;  ///< GGX widths along x and y, in [1e-3, 1]
  float metallic = 0;                      ///< in [0, 1]
  float exponent = 100;                    ///< N of cos^N, in [0, 1e5]
  float sigma_radians = 0;                 ///< standard deviation of the facets' slope angle, in [0, pi / 2]
  std::array<float, 3> lafortune_c{-1, -1, 1};
  Rgb eta{1.5f, 1.5f, 1.5f}, k{};  ///< complex index
  /// What `compensated` needs where needs_energy_table (energy_table.h) says so: of make_energy_table for this model and
  /// width, kept alive by whoever made the Scatter. Null: not compensated there; all other models share one table.
  const EnergyTable* energy = nullptr;
};

struct ScatterSample {
  Vec3f light;    ///< local; light.z > 0
  Rgb weight;     ///< f cos_light / pdf of the whole BRDF, over all its lobes; black: no sample
  float pdf = 0;  ///< per steradian, of the whole BRDF; infinite for a mirror direction (delta)
  bool is_delta() const { return !(pdf < 3e38f); }
};

/// f(light, view) times cos_light, per steradian; 0 where either z is <= 0 and for delta lobes.
Rgb evaluate(const Scatter& scatter, Vec3f light, Vec3f view);

/// The density with which sample() takes `light`, per steradian; 0 for delta lobes and where either z is <= 0. Above 0
/// wherever evaluate is. Integrates over the hemisphere to 1, or less where samples fall below the horizon and are lost.
float pdf(const Scatter& scatter, Vec3f light, Vec3f view);

/// Both at once, cheaper.
struct ScatterValue {
  Rgb value;      ///< evaluate
  float pdf = 0;  ///< per steradian
};
ScatterValue evaluate_with_pdf(const Scatter& scatter, Vec3f light, Vec3f view);

/// A light direction for u in [0, 1)^2 and lobe in [0, 1), which chooses among lobes. Needs view.z > 0.
ScatterSample sample(const Scatter& scatter, Vec3f view, Vec2f u, float lobe);

/// Whether the BRDF is nothing but delta lobes: evaluate is 0 everywhere, lights have to be found by sample().
bool is_delta(const Scatter& scatter);

/// What the surface reflects of a constant environment towards view, about, in [0, 1]: for the albedo layer and for
/// Russian roulette.
Rgb approximate_albedo(const Scatter& scatter, Vec3f view);

/// "lambert", "oren-nayar", "ggx-conductor", ...
std::string_view scatter_model_name(ScatterModel model);

}  // namespace welkin
