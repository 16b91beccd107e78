#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/envmap/environment.h>
#include <welkin/realtime/gpu_environment.h>
#include <welkin/realtime/gpu_scene.h>
#include <welkin/realtime/pass_timer.h>

// A technique: one way of lighting a scene in real time. Each is a class in welkin/realtime/techniques, known by its name to the
// command, the window and the page, which build their controls from the tables here.

namespace welkin {

/// What a technique is compared with: the path tracer's picture of the same scene (materials as prepare_scene leaves them).
enum class Truth {
  unshadowed,         ///< BRDF times environment over the hemisphere; nothing casts a shadow, nothing bounces
  direct,             ///< the same with shadows
  path,               ///< everything
  ambient_occlusion,  ///< cosine-weighted share of the hemisphere that is open
  dynamic,            ///< unshadowed, but lit by the technique's own captured environment
};

/// A number that a user may turn.
struct Parameter {
  std::string_view name;     ///< "samples"
  std::string_view meaning;  ///< one line, with its unit
  float minimum = 0, maximum = 1, initial = 0;
  bool whole = false;                         ///< integers only
  std::span<const std::string_view> choices;  ///< names for 0, 1, ...; then whole
};

/// The values of a technique's parameters, in the order of its table.
using ParameterValues = std::vector<float>;

/// The maps on the processor that some techniques need beside the ones in OpenGL. Kept alive by whoever made them.
struct EnvironmentData {
  Image radiance;                   ///< equirectangular, linear
  IblSet maps;                      ///< KernelKind::ggx, DfgForm::scale_bias
  LevelLaw law = LevelLaw::linear;  ///< of maps.specular
};

/// What one frame is drawn from. The target is bound, cleared, its viewport set.
struct Frame {
  GpuScene& scene;
  const Scene& source;  ///< what `scene` was uploaded from
  const EnvironmentData& light;
  const GpuEnvironment& environment;
  const View& view;
  const RenderTarget& target;  ///< colors[0]: radiance, alpha 1 where there is a surface; has a depth texture
  const Fullscreen& fullscreen;
  PassTimer& timer;
  double time_seconds = 0;  ///< of the animation
  int accumulated = 0;      ///< frames since anything changed: progressive techniques refine
};

class Technique {
 public:
  virtual ~Technique() = default;
  /// Draws the scene's radiance into frame.target (bind it again after other passes). The background follows by the caller where alpha is 0.
  virtual void draw(const Frame& frame, const ParameterValues& values) = 0;
  /// Whether the picture gets better when the same frame is drawn again.
  virtual bool progressive() const { return false; }
  /// The radiance that lit the last frame, 3 channels, towards directions of the world (any rotation of the environment is in it): what the truth
  /// of Truth::dynamic is lit by. Empty before the first frame and for techniques of other truths. Needs the context.
  virtual Cube captured_environment() const { return {}; }
};

struct TechniqueInfo {
  std::string_view name;     ///< "prefiltered-ggx"
  std::string_view summary;  ///< one line for people
  std::string_view source;   ///< "Karis 2013"
  Truth truth = Truth::unshadowed;
  std::span<const Parameter> parameters;
  std::unique_ptr<Technique> (*make)() = nullptr;
  /// Changes the scene to what the technique can show before it is uploaded and before the truth is rendered (all materials diffuse,
  /// say); null: nothing to change.
  void (*prepare_scene)(Scene& scene) = nullptr;
};

/// All techniques, in the order of documentation.
std::span<const TechniqueInfo> techniques();

/// Throws Error that lists the names.
const TechniqueInfo& find_technique(std::string_view name);

ParameterValues initial_values(const TechniqueInfo& technique);

/// "name" or "name:key=value,key=value" (a choice by its name or number). Throws Error naming what is wrong and the choices.
struct TechniqueChoice {
  const TechniqueInfo* technique = nullptr;
  ParameterValues values;
};
TechniqueChoice parse_technique(std::string_view text);

}  // namespace welkin
