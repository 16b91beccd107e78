#pragma once
#include <array>
#include <string>
#include <vector>

#include <welkin/envmap/reflection/split_sum.h>
#include <welkin/envmap/reflection/tap_fit.h>

// Better than the split sum with the same prefiltered map: two more look-ups (by default). Seen from the side, a GGX
// lobe is longer in the plane of incidence than across, leans towards the normal, ends at the horizon, and the Fresnel
// term pulls a second lobe out of it at grazing angles. So the lobe is made of a few taps of the same chain, spread in
// the plane of incidence, sharper than the surface or not, each with a weight F0 scale + bias of its own. All four
// numbers of a tap depend on (n.v, roughness) only and come from a small table, which is fitted to the lobe itself and
// to what a trilinear sampler sees of the chain (tap_fit.h), not to any environment. Nothing else changes: the maps and
// the DFG table are those of the split sum.

namespace welkin {

struct StretchedTapsOptions {
  int taps = 3;              ///< look-ups, 1 to 4
  int cos_size = 24;         ///< texels along cos_view, 4 to 256
  int roughness_size = 24;   ///< texels along perceptual_roughness, 4 to 256
  double light_power = 2.2;  ///< light falls like degree^-power, 0 to 4 (tap_fit.h)
};

/// Tap k of texel (i, j) belongs to cos_view = x^2, x = (i + 0.5) / cos_size, and to perceptual_roughness =
/// (j + 0.5) / roughness_size. Of each texel the scales add up to the DFG's scale, the biases to its bias.
struct StretchedTapsTable {
  ChainShape chain;  ///< that it was fitted for
  int taps = 0, cos_size = 0, roughness_size = 0;
  std::vector<StretchedTap> texels;  ///< [(j * cos_size + i) * taps + k]
};

/// Fits a table for look-ups of such a chain. About a second with the defaults. Throws Error for options out of range. Same bits on any number of
/// threads.
StretchedTapsTable make_stretched_taps_table(const ChainShape& chain,
                                             const StretchedTapsOptions& options = {});

/// Bilinear, clamped to the edge: `taps` of them; cos_view and perceptual_roughness in [0, 1].
std::vector<StretchedTap> look_up_stretched_taps(const StretchedTapsTable& table, double cos_view,
                                                 double perceptual_roughness);

/// The table as a flat texture of two channels, cos_size x (2 taps roughness_size): for tap k, from row
/// 2 k roughness_size, (offset, perceptual_roughness), and below that, from row (2 k + 1) roughness_size, (scale, bias).
Image stretched_taps_image(const StretchedTapsTable& table);

/// A GLSL function (GLSL ES 3.00, GLSL 3.30) that shades with that texture; it says what it needs.
std::string stretched_taps_glsl(const StretchedTapsTable& table);

/// A GGX surface by stretched taps. Exact for a constant environment: the weights are scaled to the exact DFG.
struct StretchedTaps {
  PrefilteredChain chain;
  StretchedTapsTable table;
  std::array<double, 3> f0{};
  double alpha = 0;
};

/// As prepare_split_sum.
StretchedTaps prepare_stretched_taps(const Image& radiance, const std::array<double, 3>& f0, double alpha,
                                     const PrefilterOptions& options = {},
                                     const StretchedTapsOptions& table = {});

/// Reflected radiance, >= 0; 0 where the view lies below the surface.
std::array<double, 3> reflect(const StretchedTaps& surface, const ReflectionQuery& query);

}  // namespace welkin
