#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace welkin {

/// The one exception that welkin throws for anything that is wrong with its input: a file, its bytes, a size,
/// a parameter. what() is one line, "path: message" (or only the message where no file is involved), fit to be
/// printed to a user as it is. Programmer errors are asserts, not exceptions.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  Error(std::string_view path, std::string_view message)
      : std::runtime_error(path.empty() ? std::string(message)
                                        : std::string(path) + ": " + std::string(message)),
        path_(path) {}

  /// The file that the error is about; empty where there is none.
  const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
};

}  // namespace welkin
