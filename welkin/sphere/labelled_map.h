#pragma once
#include <array>

#include <welkin/sphere/mapping.h>

// The labelled test environment: one colour for each of the six faces of the cube around the viewer, with the name of
// the direction written on it so that it reads correctly from the inside: N at -Z, E at +X, S at +Z, W at -X, UP at
// +Y and DOWN at -Y. Upright letters have +Y up; UP and DOWN read as when one faces north (-Z) and tilts the head. A
// map that is turned, mirrored or has a face in the wrong place is seen at once, and found by a test.

namespace welkin {

/// Which face a direction is in (order +X -X +Y -Y +Z -Z) and whether it meets a letter.
struct Label {
  int face = 0;
  bool ink = false;

  bool operator==(const Label&) const = default;
};

Label label_at(Vec3 direction);

/// Linear radiance of a label, in [0.02, 1]: letters are white, faces red, cyan, blue, yellow, green, magenta.
std::array<float, 3> label_radiance(Label label);

/// The labelled environment, each texel that of its centre (black outside discs).
SphereMap labelled_map(MapShape shape);

}  // namespace welkin
