#include "view_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include <CLI/CLI.hpp>

#include <welkin/error.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/read_scene.h>

namespace welkin {
namespace {

// ImGui lays out what has just appeared in one frame and draws it in the next.
constexpr int frames_of_a_screenshot = 3;

struct Given {
  std::string file, scene, environment, technique, against, comparison, size, exposure = "auto",
                                                                              curve = "filmic";
};

void parse_size(const std::string& text, ViewOptions& options) {
  const char *begin = text.data(), *end = begin + text.size();
  const auto [cross, first] = std::from_chars(begin, end, options.width);
  const bool crossed = first == std::errc() && cross != end && *cross == 'x';
  const auto [rest, second] = crossed ? std::from_chars(cross + 1, end, options.height)
                                      : std::from_chars_result{cross, std::errc::invalid_argument};
  if (second != std::errc() || rest != end || options.width < 16 || options.height < 16 ||
      options.width > max_picture_size || options.height > max_picture_size)
    throw CLI::ValidationError("--size", "needs WIDTHxHEIGHT from 16x16 to 4096x4096, not '" + text + "'");
}

template <std::size_t count>
int index_of(const std::string_view (&names)[count], const std::string& name, const char* option) {
  std::string known;
  for (std::size_t i = 0; i < count; ++i) {
    if (names[i] == name) return static_cast<int>(i);
    known += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  throw CLI::ValidationError(option, "'" + name + "' is none of " + known);
}

TechniqueChoice parse_choice(const std::string& text, const char* option) {
  try {
    return parse_technique(text);
  } catch (const Error& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

// FILE is what it is by its name, as when it is dropped on the window.
void place_file(const Given& given, ViewOptions& options) {
  if (!given.scene.empty()) options.scene = given.scene;
  if (!given.environment.empty()) options.environment = given.environment;
  if (given.file.empty()) return;
  const bool scene = is_scene_file(given.file);
  if (!(scene ? given.scene : given.environment).empty())
    throw CLI::ValidationError("view", given.file + " and " + (scene ? "--scene " : "--env ") +
                                           (scene ? given.scene : given.environment) + ": give one of them");
  (scene ? options.scene : options.environment) = given.file;
}

bool is_picture_file(const std::string& name) { return name.ends_with(".exr") || name.ends_with(".hdr"); }

void finish(const Given& given, ViewOptions& options) {
  place_file(given, options);
  if (!given.size.empty()) parse_size(given.size, options);
  if (!given.technique.empty()) options.technique = parse_choice(given.technique, "--technique");
  if (is_picture_file(given.against)) {
    options.reference_file = given.against;
  } else if (!given.against.empty() && given.against != "truth") {
    options.reference = ReferenceKind::technique;
    options.against = parse_choice(given.against, "--against");
  }
  if (!given.against.empty()) options.comparison = Comparison::split;
  if (!given.comparison.empty())
    options.comparison = static_cast<Comparison>(index_of(comparison_names, given.comparison, "--compare"));
  options.curve = static_cast<ToneCurve>(index_of(curve_names, given.curve, "--curve"));
  if (given.exposure != "auto") {
    char* end = nullptr;
    options.exposure_ev = std::strtof(given.exposure.c_str(), &end);
    if (*end != '\0' || given.exposure.empty() || !(std::abs(*options.exposure_ev) <= 60))
      throw CLI::ValidationError("--exposure",
                                 "needs auto or stops from -60 to 60, not '" + given.exposure + "'");
  }
  if (!options.screenshot.empty() && options.frames == 0) options.frames = frames_of_a_screenshot;
}

void declare(CLI::App& app, Given& given, ViewOptions& options) {
  app.add_option("FILE", given.file,
                 "A scene (.glb .gltf .obj .ply), or else an environment (.hdr .exr ...)");
  app.add_option("--scene", given.scene,
                 "A scene file or a built-in scene, spheres unless given (see welkin scene)");
  app.add_option("--env", given.environment,
                 "An environment: a file, sky:..., which it is unless given, or a folder of welkin ibl");
  app.add_option("--technique", given.technique, "NAME or NAME:key=value,... (welkin frame --list has them)");
  app.add_option("--against", given.against,
                 "What to compare with: truth, a stored one (.exr .hdr), or a technique as above");
  app.add_option("--compare", given.comparison, "picture, reference, split, signed-difference or difference");
  app.add_option("--size", given.size, "Of the window, WIDTHxHEIGHT; 1280x800 unless given");
  app.add_option("--map-size", options.map_size, "Texels along the edge of the environment's cubes")
      ->check(CLI::Range(16, 1024))
      ->capture_default_str();
  app.add_option("--rotate", options.rotation_degrees, "Turn the environment by so many degrees about +Y")
      ->check(CLI::Range(-36000.0, 36000.0));
  app.add_option("--exposure", given.exposure, "Stops, or auto")->capture_default_str();
  app.add_option("--curve", given.curve, "clamp, reinhard or filmic")->capture_default_str();
  app.add_option("--truth-samples", options.truth_samples, "At which the path tracer rests")
      ->check(CLI::Range(8u, 1u << 20))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "For filtering and the path tracer, 0 for all cores")
      ->check(CLI::Range(0, 1024))
      ->take_last();
  app.add_flag("!--no-panel", options.panel, "Start without the panel (Tab brings it)");
  app.add_flag("--help-overlay", options.help, "Start with the keys shown (F1)");
  app.add_option("--frames", options.frames, "Leave after so many frames of the loaded scene; 0 for never")
      ->check(CLI::Range(0, 1000000));
  app.add_option("--screenshot", options.screenshot,
                 "Write the window as it is then to this .png (and leave)");
}

int fail_usage(const CLI::ParseError& error) {
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::fprintf(stderr, "welkin: %s (see welkin view --help)\n", what.c_str());
  return 2;
}

}  // namespace

ViewOptions parse_view_options(int argc, char** argv) {
  ViewOptions options;
  Given given;
  CLI::App app("A window on a scene in its light: every technique live, beside the truth", "welkin view");
  declare(app, given, options);
  app.footer(
      "Drop scenes and environments on the window; F1 shows its keys.\nExamples:\n  welkin view park.hdr\n"
      "  welkin view room.glb --env park.exr --technique prefiltered-ggx --against truth --compare "
      "difference\n"
      "Without a display, welkin frame draws the same pictures.");
  try {
    app.parse(argc, argv);
    finish(given, options);
  } catch (const CLI::ParseError& error) {
    options.exit_code = error.get_exit_code() == 0 ? app.exit(error) : fail_usage(error);
  }
  return options;
}

}  // namespace welkin
