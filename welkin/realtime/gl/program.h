#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <welkin/geometry/affine.h>
#include <welkin/geometry/vec3f.h>
#include <welkin/image/rgb.h>
#include <welkin/realtime/gl/objects.h>

namespace welkin {

/// A 4 x 4 matrix, column after column, as OpenGL takes it.
struct Matrix4 {
  float m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// A compiled and linked program and the places of its uniforms. Setting a uniform that the linker dropped, or that
/// was never there, does nothing.
class Program {
 public:
  Program() = default;
  /// Files of welkin/realtime/shaders; `defines` are lines put before both ("#define TAPS 4"). Throws Error with the file, the
  /// stage and the driver's first message where it does not compile or link.
  Program(std::string_view vertex_file, std::string_view fragment_file, std::string_view defines = "");
#ifndef __EMSCRIPTEN__
  /// A compute program (needs ES 3.1: see has_compute()).
  static Program compute(std::string_view file, std::string_view defines = "");
#endif

  explicit operator bool() const { return static_cast<bool>(program_); }
  GLuint name() const { return program_.name(); }

  void use() const;  ///< the setters below need it to be in use
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, Vec2f value) const;
  void set(const char* uniform, Vec3f value) const;
  void set(const char* uniform, Rgb value) const;
  void set(const char* uniform, const Matrix4& value) const;
  void set_ivec4(const char* uniform, int x, int y, int z, int w) const;
  void set_vec4(const char* uniform, float x, float y, float z, float w) const;
  /// The columns of the linear part as a mat3.
  void set_linear(const char* uniform, const Affine& value) const;
  void set_vec3_array(const char* uniform, const std::vector<Vec3f>& values) const;
  void set_float_array(const char* uniform, const std::vector<float>& values) const;
  /// A sampler: binds the texture to `unit` and tells the program.
  void set_texture(const char* uniform, int unit, GLenum target, const GlTexture& texture) const;

 private:
  int place(const char* uniform) const;
  GlProgram program_;
  mutable std::unordered_map<std::string, int> places_;
};

/// Whether the context has compute shaders (ES 3.1 or above; never in the browser).
bool has_compute();

/// Draws one triangle that covers the viewport; the vertex shader is "fullscreen.vert", which gives `vec2 uv` in [0, 1], (0, 0) at the bottom left.
/// Needs a vertex array to be bound: Fullscreen owns an empty one.
class Fullscreen {
 public:
  Fullscreen() : array_(GlVertexArray::make()) {}
  void draw() const;

 private:
  GlVertexArray array_;
};

}  // namespace welkin
