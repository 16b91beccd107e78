#pragma once
#include <functional>
#include <vector>

#include <welkin/brdf/dfg.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/level_law.h>
#include <welkin/image/image.h>
#include <welkin/sh/projection.h>

namespace welkin {

enum class DiffuseMethod {
  frequency,   ///< exact to the filter's tolerance (filter.h): the default
  sh,          ///< nine coefficients (Ramamoorthi & Hanrahan 2001): what most engines use, a few per cent off
  brute_force  ///< every texel times its cosine (Greene 1986), the oracle; slow
};

struct IblOptions {
  int size = 256;  ///< texels along an edge of the specular map's level 0 and of the environment, 1 to 8192
  int levels = 0;  ///< of the specular map, at least 1, at most log2(size) + 1; 0: default_levels(size)
  KernelKind kernel = KernelKind::ggx;
  LevelLaw law = LevelLaw::linear;
  int irradiance_size = 64;  ///< 1 to 1024
  DiffuseMethod diffuse = DiffuseMethod::frequency;
  int sh_degree = 2;   ///< of the radiance coefficients, 0 to max_projection_degree
  int dfg_size = 128;  ///< 1 to 4096
  DfgForm dfg_form = DfgForm::scale_bias;
  FilterOptions filter;  ///< its progress covers all of make_ibl
};

/// What a level of the specular map is.
struct IblLevel {
  double perceptual_roughness = 0;
  double alpha = 0;    ///< GGX width, perceptual_roughness^2
  ZonalKernel kernel;  ///< not used at level 0, which is the environment itself
  FilterLevelReport report;
};

/// Everything that image-based lighting needs of one environment. Linear Rec. 709, in the units of the input.
struct IblSet {
  CubeMips environment;  ///< radiance, area-averaged; full chain of area-averaged mips
  CubeMips
      specular;  ///< radiance filtered by each level's kernel, normalised to 1; level 0 = the environment
  std::vector<IblLevel> levels;
  Cube irradiance;  ///< E = integral of L max(0, cos): pi times the radiance of a constant environment
  ShCoefficients radiance_sh;  ///< of the radiance, nothing convolved or divided
  DfgTable dfg;                ///< (scale, bias), in the form that the options ask for
  FilterReport filter;
  double seconds_environment = 0, seconds_irradiance = 0, seconds_sh = 0, seconds_dfg = 0;
};

/// As many levels as leave the last one 4 texels wide: fewer blend lobes that are too different, more end in levels
/// whose few texels blur the look-up. (The logarithmic law reaches roughness 1 only at the end of the full chain, so it
/// gets that.) See docs/methods.md for the measured error against the number of levels.
int default_levels(int size);

/// Makes the set from an equirectangular map of 3 channels, finite and >= 0. Throws Error for options out of range.
IblSet make_ibl(const Image& radiance, const IblOptions& options = {});

/// The irradiance in the directions of a cube's texels, by nine SH coefficients of the radiance (equation 13 of
/// Ramamoorthi & Hanrahan 2001 without its matrix form); negative values, which they can have, become 0.
Cube irradiance_from_sh(const ShCoefficients& radiance, int size);

/// The same by the sum over all texels (Greene 1986) in double.
Cube irradiance_brute_force(const Image& radiance, int size);

}  // namespace welkin
