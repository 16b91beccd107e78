#include "shader_files.h"

#include <map>

#include <fmt/format.h>

#include <welkin/realtime/gl/shader_observer.h>

namespace welkin {
namespace {

std::map<std::string, std::vector<std::string>> texts_of_file;

void note(std::string_view file, const std::string& text) {
  std::vector<std::string>& texts = texts_of_file[std::string(file)];
  for (const std::string& known : texts)
    if (known == text) return;
  texts.push_back(text);
}

}  // namespace

ShaderFiles::ShaderFiles() {
  texts_of_file.clear();
  observe_shaders(note);
}

ShaderFiles::~ShaderFiles() { observe_shaders(nullptr); }

std::vector<OutputFile> ShaderFiles::files(const std::string& folder) {
  std::vector<OutputFile> files;
  for (const auto& [name, texts] : texts_of_file) {
    const std::filesystem::path path(name);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const std::string own =
          i == 0 ? name : fmt::format("{}-{}{}", path.stem().string(), i + 1, path.extension().string());
      files.push_back({std::filesystem::path(folder) / own, {texts[i].begin(), texts[i].end()}});
    }
  }
  return files;
}

}  // namespace welkin
