#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace welkin {

/// A folder that is made where it is missing, with its parents, and goes again, as long as it is empty, unless kept.
/// Throws Error naming it.
class NewFolder {
 public:
  explicit NewFolder(const std::filesystem::path& path);
  ~NewFolder() { remove(); }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  void keep() { made_.clear(); }

 private:
  void remove();
  std::vector<std::filesystem::path> made_;  // innermost first
};

/// Throws Error, before any work, unless the folder, or the nearest that exists above it, can be written to.
void check_folder(const std::string& output);

}  // namespace welkin
