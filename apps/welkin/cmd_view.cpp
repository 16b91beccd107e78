#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <welkin/error.h>

#include "commands.h"

// welkin view: the window is a program of its own, welkin-view, so that this one starts on machines without a window system.

namespace welkin {
namespace {

// Beside this program, wherever it was called from; else where the shell would find it.
std::string viewer_program() {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = own.parent_path() / "welkin-view";
  return !error && std::filesystem::exists(beside, error) ? beside.string() : "welkin-view";
}

// What welkin itself was given stands first, so that the window's own takes its place.
[[noreturn]] void start_viewer(const std::string& threads, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{viewer_program()};
  if (!threads.empty()) words.insert(words.end(), {"--threads", threads});
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execvp(pointers[0], pointers.data());
  const std::string reason = errno == ENOENT ? "it is not installed beside welkin" : std::strerror(errno);
  throw Error("welkin-view", "cannot be started: " + reason);
}

}  // namespace

void add_view_command(CLI::App& app) {
  CLI::App* sub =
      app.add_subcommand("view", "A window: every technique live, beside the truth (welkin-view)");
  sub->fallthrough(false)->prefix_command();
  sub->set_help_flag();  // welkin-view has its own
  sub->callback([&app, sub] {
    const CLI::Option& threads = *app.get_option("--threads");
    start_viewer(threads.count() > 0 ? threads.results().back() : "", sub->remaining());
  });
}

}  // namespace welkin
