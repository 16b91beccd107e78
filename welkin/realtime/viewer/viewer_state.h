#pragma once
#include <welkin/realtime/renderer.h>
#include <welkin/realtime/viewer/orbit_camera.h>

namespace welkin {

/// What the picture is shown with.
enum class Comparison {
  picture,            ///< alone
  reference,          ///< the reference alone
  split,              ///< picture left, reference right of a line
  signed_difference,  ///< picture minus reference in colours: the luminance of the difference
  difference,         ///< its size in colours: the largest channel
};

/// What the picture is compared with.
enum class ReferenceKind {
  truth,      ///< an image that was given (path-traced, loaded)
  technique,  ///< another technique, or the same with other values
};

/// All that a user sets, as plain values: change them between two frames, Viewer does the rest.
struct ViewerState {
  OrbitCamera camera;
  TechniqueChoice technique;            ///< technique null: "prefiltered-ggx"
  TechniqueChoice reference_technique;  ///< for ReferenceKind::technique; null: "mirror"
  float rotation_degrees = 0;           ///< of the environment about +Y
  double time_seconds = 0;              ///< of the animation
  bool animate = false;                 ///< Viewer::advance moves the time
  bool background = true;

  ToneCurve curve = ToneCurve::filmic;
  float white = 16;                ///< of the reinhard curve
  bool automatic_exposure = true;  ///< from the log-average of the picture; exposure_ev comes on top
  float exposure_ev = 0;

  Comparison comparison = Comparison::picture;
  ReferenceKind reference = ReferenceKind::truth;
  float split = 0.5f;          ///< from the left, in widths
  float difference_scale = 0;  ///< radiance at the end of the colours; 0: fits the difference's p99
};

/// Names for command lines, lists and pages, in the order of the enumerations.
inline constexpr std::string_view comparison_names[] = {"picture", "reference", "split", "signed-difference",
                                                        "difference"};
inline constexpr std::string_view reference_names[] = {"truth", "technique"};
inline constexpr std::string_view curve_names[] = {"clamp", "reinhard", "filmic"};

/// Selects another technique with its initial values.
inline void choose_technique(TechniqueChoice& choice, const TechniqueInfo& technique) {
  choice = {&technique, initial_values(technique)};
}

inline constexpr bool shows_difference(Comparison c) {
  return c == Comparison::signed_difference || c == Comparison::difference;
}

}  // namespace welkin
