#pragma once
#include <array>
#include <span>
#include <vector>

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/lights.h>
#include <welkin/image/byte_image.h>
#include <welkin/image/tonemap.h>

namespace welkin {

/// What a sphere of the preview is made of. Reflected radiance is
///   glossy:  specular(reflected view, level of the roughness) * (f0 * scale + bias)
///   and      albedo * irradiance(normal) / pi, for what the glossy part lets through: times 1 - (f0 * scale + bias)
/// with scale and bias looked up in the set's DFG table. Single scattering only.
struct PreviewMaterial {
  bool glossy = true;
  std::array<double, 3> f0{};  ///< reflectance at normal incidence, linear Rec. 709
  double perceptual_roughness = 0;
  std::array<double, 3> albedo{};  ///< diffuse; 0 for a metal
};

/// A sphere and where it is in the preview.
struct PreviewSphere {
  PreviewMaterial material;
  double x = 0, y = 0;  ///< of its centre: pixels of the sheet, pixel (i, j) covering [i, i + 1) x [j, j + 1)
  double radius = 0;
};

/// Nine metal spheres (silver) of perceptual roughness 0, 1/8 .. 1, a matt one of albedo 0.8 and a red plastic one (F0
/// 0.04, roughness 0.25), in this order.
std::vector<PreviewSphere> preview_spheres(const IblSet& set);

/// The law that the roughnesses of the set's levels follow.
LevelLaw level_law_of(const IblSet& set);

/// How the preview is shown, all of it alike: the Reinhard curve, and an exposure half a stop above a mean of those that tone_map would choose for
/// irradiance / pi (three parts) and for the environment (one part). Irradiance says what lit things look like, however
/// small the sun; the environment keeps a dark room with one lamp from turning all black.
ToneMapOptions preview_tone(const IblSet& set, std::span<const DirectionalLight> lights = {});

/// A contact sheet, RGB sRGB, 1280 pixels wide: every level of the specular chain as a panorama (the middle looks along
/// +X, as in the equirectangular input), the spheres of preview_spheres, the irradiance / pi as a panorama, and the DFG
/// table. Everything is made from the set alone, by the look-ups that a real-time renderer does. The camera at +Z is
/// orthographic and looks along -Z with +Y up; behind the spheres is the glossy environment as a pinhole camera sees it.
/// One exposure and tone curve for all but the DFG table, whose numbers are shown as they are.
/// `lights` are those that were taken out of the set: they light the spheres, and are in none of the panoramas.
/// The set is one that make_ibl returns (nothing in it is empty).
ByteImage make_preview(const IblSet& set, std::span<const DirectionalLight> lights = {});

}  // namespace welkin
