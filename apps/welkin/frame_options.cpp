#include "frame_options.h"

#include "environment_options.h"
#include "tone_input.h"

namespace welkin {
namespace {

void add_drawing_options(CLI::App& sub, FrameCommand& command) {
  sub.add_option("-t,--technique", command.technique,
                 "How it is lit: NAME or NAME:key=value,...; --list tells all of them")
      ->capture_default_str();
  sub.add_option("--rotate", command.rotate_degrees,
                 "Turn the environment's maps about +Y by so many degrees, as the window does")
      ->check(must_be_finite);
  sub.add_option("--time", command.time_seconds, "Of the animation, seconds")
      ->check(must_be_finite)
      ->capture_default_str();
  sub.add_option("--frames", command.frames,
                 "How often the same frame is drawn: progressive techniques get better; 0: once, "
                 "progressive ones 64 times")
      ->check(CLI::Range(0, 1 << 20))
      ->capture_default_str();
  sub.add_option("--supersample", command.supersample,
                 "The mean of so many by so many samples a pixel, in linear radiance")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  sub.add_option("--map-size", command.map_size, "Texels along an edge of the environment's cube maps")
      ->check(CLI::Range(8, 4096))
      ->capture_default_str();
  sub.add_option("--maps", command.maps,
                 "Floats of the environment's maps: half (nothing above 65504, as in the window and the "
                 "page) or single")
      ->check(CLI::IsMember({"half", "single"}))
      ->capture_default_str();
}

}  // namespace

void add_frame_options(CLI::App& sub, FrameCommand& command) {
  add_scene_options(sub, command);
  sub.add_flag("--hide-env", command.hide_environment,
               "Black behind the scene; the environment still lights it");
  add_camera_options(sub, command);
  add_drawing_options(sub, command);
  sub.add_option("-o,--output", command.output,
                 "FILE.exr (radiance, alpha: coverage by surfaces), FILE.hdr, or FILE.png to look at")
      ->check(must_be_a_name);
  add_tone_options(sub, command.exposure, command.curve);
  sub.add_flag("--list", command.list, "Tell all techniques with their parameters, sources and truths");
  sub.add_flag("--json", command.json, "With --list: as JSON");
}

}  // namespace welkin
