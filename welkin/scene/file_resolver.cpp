#include <welkin/scene/file_resolver.h>

#include <algorithm>

#include <welkin/image/output_file.h>

namespace welkin {

FileResolver resolve_beside(const std::filesystem::path& path) {
  return [folder = path.parent_path()](const std::string& reference) {
    std::error_code fault;
    if (std::filesystem::exists(folder / reference, fault)) return read_file(folder / reference);
    std::string slashes = reference;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    return read_file(folder / slashes);
  };
}

}  // namespace welkin
