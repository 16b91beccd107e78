#pragma once
#include <memory>
#include <optional>

#include <welkin/image/tonemap.h>
#include <welkin/realtime/technique.h>

// The renderer that the window, the page and `welkin frame` share: holds the scene, the environment and a technique, and draws frames.
// Needs an OpenGL ES 3.0 context (HeadlessContext, GLFW's, the browser's) from its making to its end, in one thread.

namespace welkin {

struct RendererOptions {
  TexelFormat picture =
      TexelFormat::rgba16f;  ///< of the radiance that is drawn; rgba32f where errors are measured
  TexelFormat environment = TexelFormat::rgba16f;
};

/// How a finished picture is shown.
struct DisplayOptions {
  float exposure_ev = 0;
  ToneCurve curve = ToneCurve::filmic;
  float white = 16;
};

/// Pixels along either side: what every OpenGL ES 3.0 driver can draw to that WebGL 2 runs on, and a bound on memory.
inline constexpr int max_picture_size = 4096;

class Renderer {
 public:
  explicit Renderer(const RendererOptions& options = {});
  ~Renderer();

  /// The scene is kept; what the technique cannot show is changed in a copy.
  void set_scene(Scene scene);
  /// Uploads the maps (see GpuEnvironment for how they must be made).
  void set_environment(std::shared_ptr<const EnvironmentData> light);
  /// Right-handed, about +Y, in degrees.
  void set_rotation(float degrees);
  void set_technique(const TechniqueInfo& technique, ParameterValues values);
  void set_camera(const Camera& camera);
  /// In pixels. Throws Error for sizes below 1 or above max_picture_size.
  void resize(int width, int height);
  void set_time(double seconds);
  bool show_background = true;

  const Scene& scene() const;           ///< as given
  const Scene& prepared_scene() const;  ///< as the technique shows it: what the truth is rendered from
  const TechniqueInfo& technique() const;
  const ParameterValues& values() const;  ///< of its parameters
  const Camera& camera() const;
  float rotation_degrees() const;

  /// Draws one frame into the float picture. Scene, environment, technique and size must be set. Throws Error for what OpenGL reports.
  void draw();
  /// Frames that were drawn since anything changed, for progressive techniques.
  int accumulated() const;
  /// Whether the technique goes on refining the picture while nothing changes.
  bool progressive() const;

  /// Of the technique, after draw(); empty but for Truth::dynamic.
  Cube captured_environment() const;

  const RenderTarget& picture() const;
  Image read_picture() const;  ///< 4 channels, alpha 1 where there is a surface, row 0 the top
  /// Draws the picture, tone-mapped, into what is bound as draw framebuffer (0 is the screen) at its viewport.
  void show(const DisplayOptions& options, GLuint framebuffer, int x, int y, int width, int height) const;

  PassTimer& timer();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The maps that the renderer needs of an equirectangular environment.
std::shared_ptr<const EnvironmentData> make_environment_data(Image radiance, IblOptions options = {});

}  // namespace welkin
