#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace welkin {

/// Gives the bytes of a file that another file refers to by a relative name. Throws Error where it cannot.
using FileResolver = std::function<std::vector<std::uint8_t>(const std::string& reference)>;

/// Reads what is named relative to the folder of `path`; a backslash counts as a slash where there is no such file.
FileResolver resolve_beside(const std::filesystem::path& path);

}  // namespace welkin
