#pragma once
#include <welkin/realtime/capture/glossy_maps.h>

namespace welkin {

/// A kernel's taps: fitted ones with footprints (fit_quick_taps), or of filtered importance sampling with levels, for a chain of `size` texels an edge.
GlossyTaps make_quick_taps(double perceptual_roughness, int count, int size);
GlossyTaps make_importance_taps(double perceptual_roughness, int count, int size);

/// Spread of the GGX lobe (kernel_spread), radians, by roughness * 16.
std::vector<float> glossy_spreads();

/// The roughness whose lobe has this spread, at most that of roughness 1.
double roughness_of_spread(double spread_radians);

}  // namespace welkin
