#pragma once
#include <span>
#include <string_view>
#include <vector>

namespace welkin {

/// A function of an angle by its values at knots, with monotone cubic interpolation between them (Fritsch & Carlson
/// 1980): it passes through every value, never overshoots, never gets negative between values >= 0, and its slope is
/// continuous. 0 beyond the last knot.
struct KernelTable {
  std::vector<double> angles;  ///< rad, ascending, the first is 0, the last at most pi
  std::vector<double> values;  ///< >= 0
  std::vector<double> slopes;  ///< at the knots
  double evaluate(double angle) const;
};

/// Throws Error unless there are 2 to 100,000 knots, the angles rise from 0 to at most pi by more than 1e-12 each, the
/// values lie in [0, 1e30] and not all below 1e-30, and the area under the straight lines through them is at least that of
/// a rectangle 1e-4 wide and as high as the largest. The curve is made flat at angle 0, as a smooth lobe is on its axis.
KernelTable make_kernel_table(std::span<const double> angles_radians, std::span<const double> values);

/// The same from text: a line for each knot with the angle in degrees and the value, separated by spaces, a tab, a comma or a
/// semicolon; empty lines and what follows # are skipped. The last value must be
/// 0 unless it stands at 180 degrees: texels that a hard edge cuts are not integrated well. Throws Error "NAME, line N: ..." .
KernelTable parse_kernel_table(std::string_view text, std::string_view name);

/// The same from a file of at most 16 MiB. Throws Error when it cannot be read.
KernelTable load_kernel_table(std::string_view path);

}  // namespace welkin
