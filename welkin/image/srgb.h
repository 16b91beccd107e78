#pragma once

namespace welkin {

/// The sRGB transfer curve (IEC 61966-2-1): 0..1 encoded to 0..1 linear, and back.
double srgb_to_linear(double encoded);
double linear_to_srgb(double linear);

}  // namespace welkin
