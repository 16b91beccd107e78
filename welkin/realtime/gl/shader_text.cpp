#include <welkin/realtime/gl/shader_text.h>

#include <set>
#include <sstream>

#include <welkin/error.h>
#include <welkin/realtime/gl/shader_table.h>

namespace welkin {
namespace {

std::string_view stored_text(std::string_view file) {
  for (const StoredShader& shader : stored_shaders())
    if (shader.file == file) return shader.text;
  throw Error("shader " + std::string(file) + ": not in the library");
}

void append(std::string& text, std::string_view file, std::set<std::string, std::less<>>& seen) {
  if (!seen.emplace(file).second) return;
  std::istringstream lines{std::string(stored_text(file))};
  constexpr std::string_view include = "#include \"";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(include, 0) == 0) {
      append(text, line.substr(include.size(), line.rfind('"') - include.size()), seen);
    } else {
      text += line;
      text += '\n';
    }
  }
}

}  // namespace

std::string shader_text(std::string_view file) {
  std::string text;
  std::set<std::string, std::less<>> seen;
  append(text, file, seen);
  return text;
}

std::string_view shader_head(bool compute) {
  return compute
             ? "#version 310 es\nprecision highp float;\nprecision highp int;\nprecision highp image2D;\n"
               "precision highp sampler2D;\nprecision highp samplerCube;\nprecision highp sampler2DArray;\n"
               "precision highp sampler3D;\n"
             : "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
               "precision highp usampler2D;\nprecision highp samplerCube;\nprecision highp sampler2DArray;\n"
               "precision highp sampler3D;\n";
}

}  // namespace welkin
