#pragma once
#include <welkin/envmap/filter.h>

namespace welkin {

struct BorderedOptions {
  /// How far the picture of a face goes on beyond its edges, in widths of a face, 0 to 1; < 0: as far as the kernel
  /// reaches, at most 1.
  double border = -1;
  /// A square of the kernel's spread, as the paper's hardware filters with, instead of the kernel.
  bool box = false;
  /// Weigh texels by their true solid angles instead of by their areas in the picture: not as published, but the
  /// light of a lamp then counts alike wherever on a face it is. The lobe is still the same all over the picture.
  bool solid_angles = false;
};

/// Each face alone, as a flat picture with its four neighbours folded out around it as a border, filtered by one
/// kernel that is the same all over the picture: the lobe as the middle of the face sees it, K(angle) cos^3(angle) of
/// the plane (Ashikhmin & Ghosh 2003, "Simple blurry reflections with environment maps"; constant in the plane, as
/// published). Artefacts: towards the corners of a face, where a unit of the plane is a smaller angle, the lobe is
/// too narrow, by up to 3 times along the diagonal and 1.7 across it; light that lies beyond two edges at once (the
/// empty corners of the cross) and beyond the neighbours is missing; so faces that meet disagree, and seams show.
/// Measured relative RMS: 7 to 14 % on photographs of a sunset and of a night street, 57 to 130 % where a few lamps
/// or a hard sun are nearly all; see docs/approximate-filters.md. Throws Error for a border outside its range.
Cube filter_bordered(const Image& radiance, const FilterTarget& target, const BorderedOptions& options = {});

}  // namespace welkin
