#include "output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include <welkin/error.h>

namespace welkin {

NewFolder::NewFolder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path missing = std::filesystem::absolute(path).lexically_normal();
  for (; !std::filesystem::exists(missing, error) && missing.has_relative_path();
       missing = missing.parent_path())
    made_.push_back(missing);
  error.clear();
  std::filesystem::create_directories(path, error);
  if (!error) return;
  remove();
  throw Error(path.string(), "cannot make this folder: " + error.message());
}

void NewFolder::remove() {
  std::error_code ignored;
  for (const std::filesystem::path& path : made_) std::filesystem::remove(path, ignored);
}

void check_folder(const std::string& output) {
  std::error_code error;
  std::filesystem::path nearest = std::filesystem::absolute(output).lexically_normal();
  const bool there = std::filesystem::exists(nearest, error);
  if (there && !std::filesystem::is_directory(nearest, error))
    throw Error(output, "is a file; the set needs a folder");
  while (!std::filesystem::exists(nearest, error) && nearest.has_relative_path())
    nearest = nearest.parent_path();
  if (!std::filesystem::is_directory(nearest, error))
    throw Error(output, "cannot make this folder: " + nearest.string() + " is a file");
  if (::access(nearest.c_str(), W_OK | X_OK) != 0)
    throw Error(output, std::string(there ? "cannot write to" : "cannot make") +
                            " this folder: " + std::strerror(errno));
}

}  // namespace welkin
