#pragma once
#include <memory>
#include <optional>

#include <welkin/image/byte_image.h>
#include <welkin/realtime/viewer/false_color.h>
#include <welkin/realtime/viewer/viewer_state.h>

// Everything between a user and Renderer that the window and the page share. Like Renderer it needs a current OpenGL ES 3.0 context, from
// its making to its end, in one thread.

namespace welkin {

/// A rectangle of a framebuffer, pixels, from the bottom left.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

class Viewer {
 public:
  explicit Viewer(const RendererOptions& options = {});
  ~Viewer();

  ViewerState state;

  /// Frames it (state.camera). Throws Error for a scene without geometry; then the scene before stays.
  void set_scene(Scene scene);
  void set_environment(std::shared_ptr<const EnvironmentData> light);
  /// Of the picture, in pixels. Throws Error for sizes below 1 or above max_picture_size (renderer.h).
  void resize(int width, int height);
  bool has_scene() const;
  bool has_environment() const;

  /// Moves the animation, if it runs, by the seconds since the last frame.
  void advance(double seconds);
  /// Whether there is a picture to show.
  bool has_picture() const;
  /// Whether the picture is of the state as it is now, whatever may still be refined.
  bool is_current() const;
  /// Whether draw() would change the picture: something was changed, or a progressive technique goes on refining it.
  bool needs_draw() const;
  /// Takes over the state and draws the picture, and the reference technique where it is compared with. Does nothing before there is a scene,
  /// an environment and a size. A technique that cannot be made throws Error, and the state goes back to the one before.
  void draw();
  /// Shows what draw() drew, compared as the state says, tone-mapped, in a rectangle of a framebuffer (0: the screen). Nothing for empty ones.
  void show(GLuint framebuffer, const Viewport& viewport) const;
  /// The same at the picture's own size as bytes, 3 channels, row 0 the top.
  ByteImage screenshot() const;

  /// Counts the changes of what is seen (camera, scene, environment, technique and its values, size, time); how it is shown does not count.
  unsigned view_number() const;
  /// Gives the truth of the view of that number (dropped if the view has changed since): radiance, 3 channels or 4 with the coverage, any size,
  /// row 0 the top. It goes when the view changes.
  void set_truth(const Image& radiance, unsigned view_number);
  bool has_truth() const;
  /// Whether there is what the picture is compared with: else the picture is shown alone.
  bool has_reference() const;

  /// Reads both pictures and compares them; nothing where there is no reference, or where a truth has another size. draw() does so
  /// by itself, as often as it pays, while the comparison needs a reference.
  std::optional<DifferenceNumbers> measure();
  /// What was measured last for this view.
  const std::optional<DifferenceNumbers>& numbers() const;
  /// Radiance at the end of the colours.
  double difference_scale() const;
  /// Stops that the picture is shown with.
  float exposure_ev() const;

  Renderer& renderer();
  const Renderer& renderer() const;
  /// Of the last frame that is known, in the order in which they began; empty unless renderer().timer().enabled.
  const std::vector<PassTime>& passes();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin
