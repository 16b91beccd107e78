#pragma once

// The constants of the basis to degree 2, written out: private to welkin/sh. On the unit sphere
//   Y_00 = y00,  Y_1-1, Y_10, Y_11 = y1 (y, z, x),  Y_2-2, Y_2-1, Y_21 = y2 (xy, yz, xz),
//   Y_20 = y20 (3 z^2 - 1) = y20 (2 z^2 - x^2 - y^2),  Y_22 = y22 (x^2 - y^2).

namespace welkin::degree2 {

inline constexpr double y00 = 0.28209479177387814347;  // sqrt(1/(4 pi))
inline constexpr double y1 = 0.48860251190291992159;   // sqrt(3/(4 pi))
inline constexpr double y2 = 1.09254843059207907054;   // sqrt(15/(4 pi))
inline constexpr double y20 = 0.31539156525252000603;  // sqrt(5/(16 pi))
inline constexpr double y22 = 0.54627421529603953527;  // sqrt(15/(16 pi))

}  // namespace welkin::degree2
