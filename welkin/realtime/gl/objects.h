#pragma once
#include <array>
#include <cstddef>
#include <utility>

#include <welkin/realtime/gl/gl_api.h>

// Names of OpenGL objects, owned. Every object of realtime is made here, so that what lives can be counted.

namespace welkin {

enum class GlKind : unsigned char {
  texture,
  buffer,
  vertex_array,
  framebuffer,
  renderbuffer,
  program,
  query
};
inline constexpr std::size_t gl_kinds = 7;

/// Makes a name (programs: an empty program). Throws Error where the context is lost.
GLuint create_gl_object(GlKind kind);
void delete_gl_object(GlKind kind, GLuint name) noexcept;

/// How many objects of each kind were made and not deleted yet, in this process.
std::array<int, gl_kinds> living_gl_objects();

/// Owns one object; 0: none. Needs the context that made it until it is destroyed.
template <GlKind kind>
class GlObject {
 public:
  GlObject() = default;
  static GlObject make() {
    GlObject object;
    object.name_ = create_gl_object(kind);
    return object;
  }
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset() noexcept {
    if (name_ != 0) delete_gl_object(kind, std::exchange(name_, 0));
  }

 private:
  GLuint name_ = 0;
};

using GlTexture = GlObject<GlKind::texture>;
using GlBuffer = GlObject<GlKind::buffer>;
using GlVertexArray = GlObject<GlKind::vertex_array>;
using GlFramebuffer = GlObject<GlKind::framebuffer>;
using GlRenderbuffer = GlObject<GlKind::renderbuffer>;
using GlProgram = GlObject<GlKind::program>;
using GlQuery = GlObject<GlKind::query>;

/// Throws Error with `where` and the name of the first OpenGL error since the last call, if there was one.
void check_gl(const char* where);

/// Returns when everything that was asked of the context is done: for whoever reads the clock.
void wait_for_gl();

}  // namespace welkin
