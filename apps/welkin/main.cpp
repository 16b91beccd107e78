#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"

#include <welkin/error.h>
#include <welkin/image/output_file.h>
#include <welkin/parallel/parallel_for.h>

namespace {

// Files appear by renaming, so a killed run has nothing to undo but its temporary files.
extern "C" void stop(int signal_number) {
  welkin::remove_unfinished_files();
  constexpr char wipe_progress[] = "\r\033[K";
  if (::isatty(STDERR_FILENO)) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, wipe_progress, sizeof wipe_progress - 1);
  }
  ::_exit(128 + signal_number);
}

int fail(const char* what) {
  std::fprintf(stderr, "welkin: %s\n", what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  CLI::App app{"welkin: environment lighting, filtered exactly and measured.\nTry: welkin ibl sky: -o out",
               "welkin"};
  app.set_version_flag("--version", "welkin 0.1.0");
  app.require_subcommand(1);
  app.fallthrough();
  int threads = 0;
  app.add_option("--threads", threads, "Threads to use, 0 for all cores; results are the same for any number")
      ->check(CLI::Range(0, 1024))
      ->trigger_on_parse()
      ->each([](const std::string& value) { welkin::set_thread_count(std::stoi(value)); });
  welkin::add_ibl_command(app);
  welkin::add_info_command(app);
  welkin::add_convert_command(app);
  welkin::add_compare_command(app);
  welkin::add_sh_command(app);
  welkin::add_sky_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  // What is still in the buffer may not fit on a full disk, and exit() would not say so.
  if (std::fflush(stdout) != 0)
    return fail(("standard output: cannot write: " + std::string(std::strerror(errno))).c_str());
  return 0;
}
