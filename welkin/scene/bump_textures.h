#pragma once
#include <span>
#include <string_view>

#include <welkin/scene/scene.h>

namespace welkin {

/// What a normal map of make_bump_texture shows. Each tiles in both directions.
enum class BumpPattern {
  bumps,    ///< h ~ sin x sin y: smooth, the same in both directions
  noise,    ///< a Gaussian random field, isotropic: slopes are Gaussian, rms slope / 2 in each direction
  brushed,  ///< scratches along u: rms slope / 2 across them and about a fifteenth of it along them
  waves,   ///< one train of sine waves, aslant: slopes crowd at both ends of a segment of half length `slope`
  bricks,  ///< flat bricks with bevelled joints, a running bond: most is flat, little is as steep as `slope`
};

/// The names of the patterns, in their order.
std::span<const std::string_view> bump_pattern_names();

/// A normal map of 512 x 512 texels with 3 channels, (n + 1) / 2, y upwards (against v) as glTF has it. `bumps` (1 to 64): how
/// many there are to a side; `slope` (>= 0): tangent of the steepest tilt, or as the pattern says.
Texture make_bump_texture(BumpPattern pattern, int bumps, float slope);

}  // namespace welkin
