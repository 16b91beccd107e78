#pragma once
#include <array>

// The non-negative fit among functions whose degree 2 is symmetric about a given axis: private to welkin/sh.

namespace welkin::degree2 {

/// q(n) = c + 2 along (a.n) + 2 across (e.n) + zeta ((a.n)^2 - 1/3), a the axis and e the unit vector across it in whose
/// plane the linear part lies.
struct ZonalQuadric {
  double c = 0, along = 0, across = 0, zeta = 0;
};

/// The nearest such function in L2 that is >= 0 on the sphere, to rounding; entries of the size of 1.
ZonalQuadric project_nonnegative_zonal(const ZonalQuadric& f);

}  // namespace welkin::degree2
