#pragma once
#include <welkin/realtime/technique.h>

namespace welkin {

/// A technique that is one forward pass over the scene: a fragment shader with `shade`, the environment's maps, and what
/// bind() adds.
class ForwardTechnique : public Technique {
 public:
  /// `fragment_file` also names the pass in the timer; both names must live as long as the object.
  explicit ForwardTechnique(const char* fragment_file, const char* vertex_file = "mesh.vert",
                            std::string_view defines = "")
      : program_(vertex_file, fragment_file, defines), name_(fragment_file) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    prepare(frame, values);
    const PassTimer::Scope timed(frame.timer, name_);
    program_.use();
    set_environment(program_, frame.environment);
    bind(program_, frame, values);
    draw_scene(program_, frame.scene, frame.view);
  }

 protected:
  /// Before the pass: makes maps that are missing or out of date.
  virtual void prepare(const Frame&, const ParameterValues&) {}
  /// Sets uniforms and textures (units from first_technique_unit) of its own; the program is in use.
  virtual void bind(const Program&, const Frame&, const ParameterValues&) {}

 private:
  Program program_;
  const char* name_;
};

}  // namespace welkin
