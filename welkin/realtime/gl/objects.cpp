#include <welkin/realtime/gl/objects.h>

#include <atomic>
#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

std::array<std::atomic<int>, gl_kinds> living{};

GLuint generate(GlKind kind) {
  GLuint name = 0;
  switch (kind) {
    case GlKind::texture: glGenTextures(1, &name); break;
    case GlKind::buffer: glGenBuffers(1, &name); break;
    case GlKind::vertex_array: glGenVertexArrays(1, &name); break;
    case GlKind::framebuffer: glGenFramebuffers(1, &name); break;
    case GlKind::renderbuffer: glGenRenderbuffers(1, &name); break;
    case GlKind::program: name = glCreateProgram(); break;
    case GlKind::query: glGenQueries(1, &name); break;
  }
  return name;
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM: return "invalid enum";
    case GL_INVALID_VALUE: return "invalid value";
    case GL_INVALID_OPERATION: return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY: return "out of memory";
    default: return "unknown error";
  }
}

}  // namespace

GLuint create_gl_object(GlKind kind) {
  const GLuint name = generate(kind);
  if (name == 0) throw Error("OpenGL: no objects can be made: the context is lost");
  ++living[static_cast<std::size_t>(kind)];
  return name;
}

void delete_gl_object(GlKind kind, GLuint name) noexcept {
  switch (kind) {
    case GlKind::texture: glDeleteTextures(1, &name); break;
    case GlKind::buffer: glDeleteBuffers(1, &name); break;
    case GlKind::vertex_array: glDeleteVertexArrays(1, &name); break;
    case GlKind::framebuffer: glDeleteFramebuffers(1, &name); break;
    case GlKind::renderbuffer: glDeleteRenderbuffers(1, &name); break;
    case GlKind::program: glDeleteProgram(name); break;
    case GlKind::query: glDeleteQueries(1, &name); break;
  }
  --living[static_cast<std::size_t>(kind)];
}

std::array<int, gl_kinds> living_gl_objects() {
  std::array<int, gl_kinds> counts{};
  for (std::size_t i = 0; i < gl_kinds; ++i) counts[i] = living[i];
  return counts;
}

void wait_for_gl() { glFinish(); }

void check_gl(const char* where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
  throw Error(std::string("OpenGL: ") + error_name(error) + " in " + where);
}

}  // namespace welkin
