#pragma once
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/mapping.h>
#include <welkin/sphere/mat3.h>

// Radiance from one layout of the sphere to another, of any size.
//
// Where the target is coarser than the source, every target texel gets the mean of the source over its own patch of
// the sphere, with each source texel a patch of constant radiance: exact areas of overlap, no sampling, no aliasing.
// Where it is finer (from twice as fine up), the source is interpolated by a smooth positive kernel on the sphere,
// the normalised sum of (1 - (distance / radius)^2)^3 over texel centres, radius 1.7 texels, which knows nothing of
// faces, seams and poles: twice differentiable across all of them, never outside the range of its neighbours, never
// negative. In between the two are blended by the local ratio of texel sizes. Equal mapping, size and orientation is a copy.
//
// Fastest from an equirectangular map, whose width 4 divides, to a cube as it stands (cube_mirrors.h).
//
// A constant stays constant to float rounding. Overlap and interpolation lose or gain a little energy (the kernel
// mostly, and texels that straddle a cut); it is put back by one factor per channel, close to 1.

namespace welkin {

struct ResampleOptions {
  /// Scale each channel so that the integral over the sphere is that of the source (to float rounding).
  bool keep_energy = true;
  /// false: every target texel gets the mean over its patch, however fine it is, as if the source were seen through a
  /// magnifying glass: exact for the model of texels as patches of constant radiance, and blocky.
  bool interpolate = true;
  /// Turns (or mirrors) the environment on the way: what the source shows in direction d the result shows in
  /// orientation * d. Must be orthogonal to 1e-6; see orientation.h.
  Mat3 orientation;
};

/// What a resampling did, for those who report it.
struct ResampleReport {
  /// Target energy over source energy before it was put back, per channel (1 = nothing lost); 1 for a black channel.
  std::vector<double> raw_energy_ratio;
};

/// Integral of a map over the sphere, per channel (radiance times sr), with exact texel solid angles; a vector of
/// `channels` (1 to 4) numbers, the same on any number of threads.
std::vector<double> map_energy(const SphereMap& map);

/// `source` in another shape. Throws Error when either shape is not valid (check_map_shape) or the source has more
/// than 4 channels, or the orientation is not orthogonal (NaN and infinity included). The same bytes on any number of threads.
SphereMap resample(const SphereMap& source, MapShape target, const ResampleOptions& options = {},
                   ResampleReport* report = nullptr);

/// An equirectangular image as a cube of `size` texels along an edge.
Cube equirect_to_cube(const Image& equirect, int size, const ResampleOptions& options = {});

/// A cube as an equirectangular image.
Image cube_to_equirect(const Cube& cube, int width, int height, const ResampleOptions& options = {});

}  // namespace welkin
