#include <welkin/sh/basis.h>

#include <cassert>
#include <cmath>
#include <numbers>

namespace welkin {

// Fully normalised P_lm(cos theta), positive for small theta:
//   P_mm = sqrt((2m+1)/(2m)) sin theta P_(m-1)(m-1),  P_00 = 1/sqrt(4 pi)
//   P_lm = a (cos theta P_(l-1)m - b P_(l-2)m),  a^2 = (4l^2-1)/(l^2-m^2),  b^2 = ((l-1)^2-m^2)/(4(l-1)^2-1)
// and Y_lm = sqrt2 P_lm cos m phi, Y_l-m = sqrt2 P_lm sin m phi for m > 0.
void evaluate_sh_basis(Vec3 direction, int max_degree, std::span<double> out) {
  assert(max_degree >= 0 && max_degree <= max_basis_degree && out.size() >= sh_count(max_degree));
  const double cos_theta = direction.z, sin_theta = std::hypot(direction.x, direction.y);
  const double cos_phi = sin_theta > 0 ? direction.x / sin_theta : 1;
  const double sin_phi = sin_theta > 0 ? direction.y / sin_theta : 0;
  double diagonal = 0.5 / std::sqrt(std::numbers::pi);
  double cos_m = 1, sin_m = 0;
  for (int m = 0; m <= max_degree; ++m) {
    if (m > 0) {
      diagonal *= std::sqrt((2.0 * m + 1) / (2.0 * m)) * sin_theta;
      const double next_cos = cos_m * cos_phi - sin_m * sin_phi;
      sin_m = sin_m * cos_phi + cos_m * sin_phi;
      cos_m = next_cos;
    }
    const double root2 = m > 0 ? std::numbers::sqrt2 : 1;
    double previous = 0, current = diagonal, previous_a = 0;
    for (int l = m; l <= max_degree; ++l) {
      if (l > m) {
        const double ll = l, mm = m;
        const double a = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
        const double b = l > m + 1 ? 1 / previous_a : 0;  // b of l is 1/a of l - 1
        const double next = a * (cos_theta * current - b * previous);
        previous = current;
        current = next;
        previous_a = a;
      }
      out[sh_index(l, m)] = root2 * current * cos_m;
      if (m > 0) out[sh_index(l, -m)] = root2 * current * sin_m;
    }
  }
}

}  // namespace welkin
