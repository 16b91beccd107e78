#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "stop_signal.h"

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace {

// One line, whatever the parser's text looks like.
int fail_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::string what = error.what(), command = "welkin";
  std::replace(what.begin(), what.end(), '\n', ' ');
  for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
  std::fprintf(stderr, "welkin: %s (see %s --help)\n", what.c_str(), command.c_str());
  return 2;
}

int fail(const char* what) {
  std::fprintf(stderr, "welkin: %s\n", what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  welkin::handle_stop_signals();
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
  welkin::add_filter_command(app);
  welkin::add_info_command(app);
  welkin::add_convert_command(app);
  welkin::add_compare_command(app);
  welkin::add_reflect_command(app);
  welkin::add_brdf_command(app);
  welkin::add_render_command(app);
  welkin::add_frame_command(app);
  welkin::add_sh_command(app);
  welkin::add_sampling_command(app);
  welkin::add_scene_command(app);
  welkin::add_sky_command(app);
  welkin::add_view_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : fail_usage(app, error);
  } catch (const welkin::Stopped& stopped) {
    fail(stopped.what());
    return 128 + stopped.signal_number();
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
