#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <welkin/sh/projection.h>
#include <welkin/sh/quantity.h>
#include <welkin/sphere/mat3.h>

// The nine coefficients of degree 2 as the engines store them: which factors are multiplied in, which signs, which
// order, which axes. docs/conventions.md has the table; each was read in the engine's own source:
//   three.js r155 and later   SphericalHarmonics3.getIrradianceAt, shGetIrradianceAt (lights_pars_begin): radiance
//   Babylon.js 5 and later    SphericalPolynomial (sphericalPolynomial.ts), "irradiance" of an .env file;
//                             SphericalHarmonics.FromPolynomial, computeEnvironmentIrradiance (harmonicsFunctions)
//   Filament 1.x              IndirectLight::Builder::irradiance, sh.txt of cmgen, Irradiance_SphericalHarmonics
//   Unity 2019.4 and later    SphericalHarmonicsL2, PackCoefficients (SphericalHarmonics.cs of HDRP), ShadeSH9
//   Unreal Engine 4.27 and 5  FSHVectorRGB3, SetupSkyIrradianceEnvironmentMapConstantsFromSkyIrradiance,
//                             GetSkySHDiffuse
//   Godot 4                   light probes of a LightmapGI: MODE_LIGHT_PROBES of lm_compute.glsl, lightmap captures of
//                             scene_forward_clustered.glsl
// Axes are those that a glTF scene gets in the engine's usual importer, so that light and model stay together.

namespace welkin {

/// A form in which coefficients are written and read.
enum class ShForm { json, three, babylon, filament, unity, unreal, godot, c, glsl, hlsl };

inline constexpr std::array<ShForm, 10> all_sh_forms{
    ShForm::json,   ShForm::three, ShForm::babylon, ShForm::filament, ShForm::unity,
    ShForm::unreal, ShForm::godot, ShForm::c,       ShForm::glsl,     ShForm::hlsl};

/// "json", "three", ...: what --form takes.
std::string_view sh_form_name(ShForm form);

/// The form of that name. Throws Error, which lists all, for another name.
ShForm parse_sh_form(std::string_view name);

/// The direction in the engine's axes that our direction d becomes is sh_form_axes(form) * d; a matrix of one 1 or -1
/// in each row, a reflection for the left-handed engines.
Mat3 sh_form_axes(ShForm form);

/// What the engine's own formula gives with these numbers: irradiance for three (its BRDF has the 1 / pi), irradiance
/// over pi for all others. Not for json, which says it itself.
ShQuantity sh_form_quantity(ShForm form);

/// The 27 numbers of a form, three channels for each of nine terms in the engine's order.
using ShFormNumbers = std::array<double, 27>;

/// The engine's numbers from the radiance (3 channels, degree at most 2; what is missing counts as 0). Not for json.
ShFormNumbers to_sh_form(const ShCoefficients& radiance, ShForm form);

/// The reverse: radiance of degree 2 in our basis and axes.
ShCoefficients from_sh_form(const ShFormNumbers& numbers, ShForm form);

}  // namespace welkin
