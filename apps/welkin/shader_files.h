#pragma once
#include <string>
#include <vector>

#include <welkin/image/output_file.h>

namespace welkin {

/// Collects the shaders that are compiled as long as it lives. One at a time.
class ShaderFiles {
 public:
  ShaderFiles();
  ~ShaderFiles();
  ShaderFiles(const ShaderFiles&) = delete;
  ShaderFiles& operator=(const ShaderFiles&) = delete;

  /// Each text once; the second text of one file (other defines) is "name-2.frag".
  static std::vector<OutputFile> files(const std::string& folder);
};

}  // namespace welkin
