#pragma once
#include <filesystem>
#include <string>

namespace welkin {

/// The last extension of a name with its dot, ASCII letters in lower case: ".exr" for "a.b.EXR", "" where there is none.
inline std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

}  // namespace welkin
