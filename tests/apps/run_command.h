#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

// Running the built command as a user does: its own process, its own folder, its exit code and what it printed.

namespace welkin {

/// A new empty folder, removed with all that is in it at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

struct RunResult {
  int exit_code = -1;  ///< 128 + the number of the signal that ended the process, as a shell says it
  std::string out, err;
};

struct RunOptions {
  std::filesystem::path folder;   ///< where it runs
  std::uint64_t file_limit = 0;   ///< bytes that a file can have, a full disk; 0 does not limit
  bool obey_permissions = false;  ///< as root too
  std::string standard_output;    ///< a file to open for standard output; empty: captured
};

/// Runs `welkin` with these arguments and waits for it.
RunResult run_welkin(const std::vector<std::string>& arguments, const RunOptions& options);

/// Starts `welkin` and returns its process; standard output and standard error go to the descriptor.
pid_t start_welkin(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   int output);

/// Waits for a process; its exit code as in RunResult.
int wait_for(pid_t process);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// Every file below a folder with its bytes, by path relative to the folder.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

/// How many lines a text has; a last line without its end counts.
std::size_t line_count(const std::string& text);

}  // namespace welkin
