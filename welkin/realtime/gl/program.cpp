#include <welkin/realtime/gl/program.h>

#include <algorithm>

#include <welkin/error.h>
#include <welkin/realtime/gl/shader_observer.h>
#include <welkin/realtime/gl/shader_text.h>

namespace welkin {
namespace {

ShaderObserver shader_observer = nullptr;

// The first line of a driver's message that says something.
std::string first_line(const std::string& log) {
  const auto begin = log.find_first_not_of("\r\n \t");
  if (begin == std::string::npos || log[begin] == '\0') return "no message from the driver";
  return log.substr(begin, log.find_first_of(std::string_view("\r\n\0", 3), begin) - begin);
}

// Deletes the shader object when it is linked, or when it fails.
struct ShaderStage {
  GLuint name;
  explicit ShaderStage(GLenum kind) : name(glCreateShader(kind)) {}
  ~ShaderStage() { glDeleteShader(name); }
  ShaderStage(const ShaderStage&) = delete;
  ShaderStage& operator=(const ShaderStage&) = delete;
};

void compile(const ShaderStage& stage, std::string_view file, std::string_view defines, bool compute) {
  std::string text(shader_head(compute));
  text += defines;
  if (!defines.empty() && defines.back() != '\n') text += '\n';
  text += shader_text(file);
  if (shader_observer != nullptr) shader_observer(file, text);
  const char* source = text.c_str();
  glShaderSource(stage.name, 1, &source, nullptr);
  glCompileShader(stage.name);
  GLint compiled = 0;
  glGetShaderiv(stage.name, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return;
  std::string log(4096, '\0');
  glGetShaderInfoLog(stage.name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error("shader " + std::string(file) + " does not compile: " + first_line(log));
}

void link(const GlProgram& program, std::string_view file) {
  glLinkProgram(program.name());
  GLint linked = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(4096, '\0');
  glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error("shader " + std::string(file) + " does not link: " + first_line(log));
}

}  // namespace

void observe_shaders(ShaderObserver observer) { shader_observer = observer; }

Program::Program(std::string_view vertex_file, std::string_view fragment_file, std::string_view defines)
    : program_(GlProgram::make()) {
  const ShaderStage vertex(GL_VERTEX_SHADER), fragment(GL_FRAGMENT_SHADER);
  compile(vertex, vertex_file, defines, false);
  compile(fragment, fragment_file, defines, false);
  glAttachShader(program_.name(), vertex.name);
  glAttachShader(program_.name(), fragment.name);
  link(program_, fragment_file);
}

#ifndef __EMSCRIPTEN__
Program Program::compute(std::string_view file, std::string_view defines) {
  Program program;
  program.program_ = GlProgram::make();
  const ShaderStage stage(GL_COMPUTE_SHADER);
  compile(stage, file, defines, true);
  glAttachShader(program.name(), stage.name);
  link(program.program_, file);
  return program;
}
#endif

void Program::use() const { glUseProgram(program_.name()); }

int Program::place(const char* uniform) const {
  const auto known = places_.find(uniform);
  if (known != places_.end()) return known->second;
  const int found = glGetUniformLocation(program_.name(), uniform);
  places_.emplace(uniform, found);
  return found;
}

void Program::set(const char* uniform, int value) const { glUniform1i(place(uniform), value); }
void Program::set(const char* uniform, float value) const { glUniform1f(place(uniform), value); }
void Program::set(const char* uniform, Vec2f value) const { glUniform2f(place(uniform), value.x, value.y); }
void Program::set(const char* uniform, Vec3f value) const {
  glUniform3f(place(uniform), value.x, value.y, value.z);
}
void Program::set(const char* uniform, Rgb value) const {
  glUniform3f(place(uniform), value.r, value.g, value.b);
}
void Program::set(const char* uniform, const Matrix4& value) const {
  glUniformMatrix4fv(place(uniform), 1, GL_FALSE, value.m);
}
void Program::set_vec4(const char* uniform, float x, float y, float z, float w) const {
  glUniform4f(place(uniform), x, y, z, w);
}
void Program::set_ivec4(const char* uniform, int x, int y, int z, int w) const {
  glUniform4i(place(uniform), x, y, z, w);
}
void Program::set_linear(const char* uniform, const Affine& a) const {
  const float columns[9] = {a.x.x, a.x.y, a.x.z, a.y.x, a.y.y, a.y.z, a.z.x, a.z.y, a.z.z};
  glUniformMatrix3fv(place(uniform), 1, GL_FALSE, columns);
}
void Program::set_vec3_array(const char* uniform, const std::vector<Vec3f>& values) const {
  if (!values.empty()) glUniform3fv(place(uniform), static_cast<GLsizei>(values.size()), &values.front().x);
}
void Program::set_float_array(const char* uniform, const std::vector<float>& values) const {
  if (!values.empty()) glUniform1fv(place(uniform), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set_texture(const char* uniform, int unit, GLenum target, const GlTexture& texture) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, texture.name());
  set(uniform, unit);
}

bool has_compute() {
#ifdef __EMSCRIPTEN__
  return false;
#else
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return major > 3 || (major == 3 && minor >= 1);
#endif
}

void Fullscreen::draw() const {
  glBindVertexArray(array_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace welkin
