#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/gl/shader_observer.h>
#include <welkin/realtime/gl/shader_table.h>
#include <welkin/realtime/gl/shader_text.h>
#include "tests/comparison/small_renderer.h"

// Every shader is OpenGL ES 3.00 (compute 3.10) to the letter: Khronos' own compiler takes it, with the defines that the techniques
// give it. Drivers are more lenient than the browser.

namespace welkin {
namespace {

namespace fs = std::filesystem;

std::set<std::pair<std::string, std::string>> seen;  // file, text

void note(std::string_view file, const std::string& text) { seen.emplace(file, text); }

/// The technique's parameters at their first values, then each choice of each parameter.
std::vector<ParameterValues> variations(const TechniqueInfo& technique) {
  std::vector<ParameterValues> all{initial_values(technique)};
  for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
    const Parameter& parameter = technique.parameters[i];
    ParameterValues values = initial_values(technique);
    for (std::size_t choice = 0; choice < parameter.choices.size(); ++choice) {
      values[i] = static_cast<float>(choice);
      all.push_back(values);
    }
  }
  return all;
}

void draw_all_variations() {
  SmallRenderer small(8, 6);
  for (const TechniqueInfo& technique : techniques()) {
    for (const ParameterValues& values : variations(technique)) {
      small.renderer.set_technique(technique, values);
      small.renderer.draw();
    }
  }
}

bool is_stage(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  return extension == ".vert" || extension == ".frag" || extension == ".comp";
}

// What no technique was seen to compile (the viewer's own) is compiled as it stands.
void add_the_rest() {
  std::set<std::string> files;
  for (const auto& [file, text] : seen) files.insert(file);
  for (const StoredShader& shader : stored_shaders()) {
    const std::string file(shader.file);
    if (is_stage(file) && files.count(file) == 0)
      seen.emplace(file, std::string(shader_head(file.ends_with(".comp"))) + shader_text(file));
  }
}

/// What the compiler says; empty where it is content.
std::string complaints(const std::string& file, const std::string& text, const fs::path& folder) {
  const fs::path source = folder / ("shader" + fs::path(file).extension().string());
  std::ofstream(source) << text;
  const std::string command = "glslangValidator " + source.string() + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) output += buffer;
  return pclose(pipe) == 0 ? "" : output;
}

class Folder {
 public:
  Folder() {
    char name[] = "/tmp/welkin-shaders-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

TEST(Shaders, AreStrictlyOpenGlEs) {
  const Folder folder;
  ASSERT_NE(complaints("wrong.frag", "#version 300 es\nvoid main() { int i = 1.0; }\n", folder.path), "");
  {
    const HeadlessContext context;
    observe_shaders(note);
    draw_all_variations();
    observe_shaders(nullptr);
  }
  add_the_rest();
  EXPECT_GE(seen.size(), techniques().size());
  for (const auto& [file, text] : seen) {
    const std::string_view version = std::string_view(text).substr(0, text.find('\n'));
    EXPECT_EQ(version, file.ends_with(".comp") ? "#version 310 es" : "#version 300 es") << file;
    EXPECT_EQ(complaints(file, text, folder.path), "") << file;
  }
}

}  // namespace
}  // namespace welkin
