#pragma once
#include <span>
#include <string_view>

namespace welkin {

struct StoredShader {
  std::string_view file, text;
};

/// The files of welkin/realtime/shaders, as the build put them into the library (cmake/EmbedShaders.cmake).
std::span<const StoredShader> stored_shaders();

}  // namespace welkin
