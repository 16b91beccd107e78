#pragma once
#include <optional>
#include <span>
#include <vector>

#include <welkin/sphere/direction_index.h>
#include <welkin/sphere/equirect_neighbours.h>
#include <welkin/sphere/patch_mean.h>

// Inside of resample.cpp: the weights of the source's texels in a target texel, mean over the patch and smooth
// interpolation together.

namespace welkin {

/// What all threads share for one source and target. `interpolate` = false leaves the interpolation out.
class ResampleGeometry {
 public:
  ResampleGeometry(const MapSource& source, MapShape target, bool interpolate);

  const MapSource& source() const { return source_; }
  MapShape target() const { return target_; }
  const DensityTable& density() const { return density_; }

  /// How much of the interpolation a direction of the target gets, in [0, 1].
  double smooth_share(Vec3 direction) const;

  /// Appends the interpolation's weights (not normalised) for a direction of the target; returns their sum, 0 where
  /// no texel is within reach.
  double append_smooth(Vec3 direction, std::vector<TexelWeight>& weights) const;

 private:
  bool any_magnified() const;

  const MapSource& source_;
  MapShape target_;
  DensityTable density_;
  bool interpolate_;
  std::optional<EquirectNeighbours> neighbours_;
  std::optional<DirectionIndex> index_;
};

/// The weights of target texels, one after the other; quickest row by row from the left.
class TexelWeights {
 public:
  /// Only texels of the first `columns` columns will be asked for.
  TexelWeights(const ResampleGeometry& geometry, int columns);

  /// Weights that add up to 1, valid until the next call.
  std::span<const TexelWeight> operator()(int x, int y);

 private:
  const ResampleGeometry& geometry_;
  PatchMean patch_mean_;
  std::vector<TexelWeight> weights_;
};

}  // namespace welkin
