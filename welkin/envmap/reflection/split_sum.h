#pragma once
#include <array>

#include <welkin/brdf/dfg.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/level_law.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>

namespace welkin {

/// The prefiltered map that look-ups go to.
struct PrefilterOptions {
  int size = 256;  ///< texels along an edge of level 0, 1 to 8192
  int levels = 0;  ///< at least 2, at most log2(size) + 1; 0: default_levels(size)
  LevelLaw law = LevelLaw::linear;
  FilterOptions filter;
};

/// What a consumer knows of a chain of prefiltered levels.
struct ChainShape {
  int size = 256;  ///< of level 0
  int levels = 7;  ///< at least 2
  LevelLaw law = LevelLaw::linear;
};

/// A chain of radiance filtered by the kernel ggx, as `welkin ibl` writes it (specular): level 0 is the environment.
struct PrefilteredChain {
  CubeMips levels;
  LevelLaw law = LevelLaw::linear;

  ChainShape shape() const { return {levels.size(), static_cast<int>(levels.levels.size()), law}; }
};

/// Throws Error for options out of range.
PrefilteredChain make_prefiltered_chain(const Image& radiance, const PrefilterOptions& options = {});

/// Trilinear look-up, as a consumer's sampler does it.
std::array<double, 3> look_up(const PrefilteredChain& chain, Vec3 direction, double perceptual_roughness);

/// A GGX surface by the split sum (Karis 2013): one look-up of the chain in the mirrored view, made with n = v = r,
/// times F0 scale + bias. Exact for a constant environment; the lobe has the shape that it has seen from the normal.
struct SplitSum {
  PrefilteredChain chain;
  std::array<double, 3> f0{};
  double alpha = 0;
};

/// alpha in [1e-3, 1], f0 in [0, 1]; throws Error beyond. Schlick's Fresnel term with f90 = 1.
SplitSum prepare_split_sum(const Image& radiance, const std::array<double, 3>& f0, double alpha,
                           const PrefilterOptions& options = {});

/// Reflected radiance; 0 where the view lies below the surface.
std::array<double, 3> reflect(const SplitSum& surface, const ReflectionQuery& query);

}  // namespace welkin
