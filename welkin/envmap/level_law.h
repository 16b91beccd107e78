#pragma once
#include <string_view>

#include <welkin/envmap/zonal_kernel.h>

// Which roughness a mip level of a prefiltered cube stands for. alpha = perceptual_roughness^2.

namespace welkin {

enum class LevelLaw {
  linear,      ///< level = perceptual_roughness (levels - 1): the default, and what most viewers assume
  quadratic,   ///< level = (levels - 1) r (2 - r): Filament, and three.js for a ready-made map
  logarithmic  ///< level = log2(size * alpha): Babylon.js with lodGenerationScale 1; the first level is mirror
};

/// "linear", "quadratic", "log2". Throws Error naming the choices.
LevelLaw parse_level_law(std::string_view name);
std::string_view name(LevelLaw law);
/// The formula that a shader uses, as text for manifests, with r = perceptual_roughness.
std::string_view formula(LevelLaw law);

/// perceptual_roughness in [0, 1] of a level (it may be fractional), 0 <= level <= levels - 1; size is that of level 0.
double level_to_perceptual_roughness(LevelLaw law, double level, int levels, int size);

/// The inverse: the level to look up, clamped to [0, levels - 1].
double perceptual_roughness_to_level(LevelLaw law, double perceptual_roughness, int levels, int size);

/// The kernel of a family for a GGX width alpha in (0, 1]: ggx itself; phong with N = 1 + (1/alpha^2 - 1)/2, which has
/// the same spread for small alpha and is the Lambert lobe at alpha = 1; gaussian with sigma = 1/sqrt(N);
/// vmf with kappa = N; blinn-phong with 2/alpha^2 - 2 (Walter et al. 2007, section 5.3), the same spread again. lambert
/// ignores alpha.
ZonalKernel kernel_for_alpha(KernelKind kind, double alpha);

}  // namespace welkin
