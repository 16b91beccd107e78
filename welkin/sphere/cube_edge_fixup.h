#pragma once
#include <optional>
#include <string_view>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// Cubes for samplers that do not filter across faces (Isidoro & Mitchell 2005, Angular extent filtering with edge fixup
// for seamless cubemap filtering, CubeMapGen; Castano 2012 for the warp). Such a sampler clamps a look-up to the face
// that the direction pierces, so half a texel before an edge it stops to blend, and a step shows where two faces meet.

namespace welkin {

enum class EdgeFixup {
  none,
  /// The texels next to an edge are samples exactly on it, N texels span the face from edge to edge: texel x has its
  /// centre at s = 2x/(N - 1) - 1, and both faces hold the same values there. The consumer multiplies the two smaller
  /// components of a direction by (N - 1)/N before it looks up. The look-up is continuous and keeps its sharpness.
  warp,
  /// Texels that touch each other across an edge (two) or at a corner (three) get their mean; what that adds falls off
  /// smoothly over the next texels inwards (edge_falloff). The consumer does nothing. Continuous, but flat there.
  average
};

/// "none", "warp", "average", and back.
std::string_view edge_fixup_name(EdgeFixup fixup);
std::optional<EdgeFixup> edge_fixup_from_name(std::string_view name);

/// Texels that EdgeFixup::average changes from an edge inwards, where the face is wide enough.
inline constexpr int edge_falloff = 4;

/// The cube for a sampler that clamps to faces. Warped texels are interpolated with Catmull-Rom cubics, never beyond
/// the four nearest texels, and those that coincide on an edge or corner are equal to the last bit. A cube of one texel
/// a face becomes its mean (except with `none`). Up to 4 channels.
Cube fix_edges(const Cube& cube, EdgeFixup fixup);
CubeMips fix_edges(const CubeMips& cube, EdgeFixup fixup);

/// The look-up of such a sampler: bilinear, clamped to the face that a direction (of any length > 0) pierces, with the
/// consumer's scale under EdgeFixup::warp. out has one value a channel.
void look_up_cube_face(const Cube& cube, Vec3 direction, EdgeFixup fixup, float* out);

/// The step that this look-up makes across edges: RMS over points on all 12 edges of the difference between the two
/// faces, over the RMS of their mean. 0 is continuous.
double face_edge_step(const Cube& cube, EdgeFixup fixup);

}  // namespace welkin
