#include "source_name.h"

#include <filesystem>

#include <welkin/envmap/sky/sky.h>

namespace welkin {

std::string source_name(const std::string& input) {
  return is_sky_spec(input) ? input : std::filesystem::path(input).filename().string();
}

}  // namespace welkin
