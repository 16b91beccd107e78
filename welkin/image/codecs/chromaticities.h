#pragma once
#include <array>

// RGB spaces given by the CIE xy of their primaries and white.

namespace welkin {

struct Chromaticities {
  std::array<double, 2> red{0.64, 0.33}, green{0.30, 0.60}, blue{0.15, 0.06},
      white{0.3127, 0.3290};  // Rec.709, D65
};

/// Row by row: m[3 * i + j].
using ColourMatrix = std::array<double, 9>;

/// Takes linear RGB of the space `from` to CIE XYZ, white to Y = 1 (SMPTE RP 177-1993). All zero when the
/// primaries lie on one line or a y is zero, so that no such space exists.
ColourMatrix rgb_to_xyz(const Chromaticities& from);

/// Takes CIE XYZ to linear Rec.709; the D65 white of Y = 1 gives (1, 1, 1).
ColourMatrix xyz_to_rec709();

/// Takes linear RGB of the space `from` to linear Rec.709. White goes to white: XYZ is scaled by the ratio of
/// the two whites. All zero when there is no such space.
ColourMatrix rgb_to_rec709(const Chromaticities& from);

/// m applied to an RGB or XYZ triple in place.
void transform_colour(const ColourMatrix& m, float* triple);

}  // namespace welkin
