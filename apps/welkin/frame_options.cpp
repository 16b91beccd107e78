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

void add_measuring_options(CLI::App& sub, FrameCommand& command) {
  sub.add_option(
         "--reference", command.reference,
         "Compare with the path tracer's picture of what the technique stands for, of so many samples a "
         "pixel (256), or with FILE.exr, as welkin render writes it; FILE-truth and FILE-difference.png "
         "are written beside the picture")
      ->expected(0, 1)
      ->default_str("256");
  sub.add_option(
         "--sheet", command.sheet,
         "With --reference: picture, truth and difference side by side, with the errors: FILE.png or .jpg")
      ->check(must_be_a_name);
  sub.add_option("--shaders", command.shaders,
                 "Write the technique's shaders, whole, as they were compiled, into this folder")
      ->check(must_be_a_name);
  sub.add_option("--times", command.timed_frames,
                 "Draw so many more frames (9), and tell how long each pass takes: medians")
      ->expected(0, 1)
      ->default_str("9")
      ->check(CLI::Range(1, 100000));
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
  add_measuring_options(sub, command);
  sub.add_flag("--list", command.list, "Tell all techniques with their parameters, sources and truths");
  sub.add_flag("--json", command.json, "The figures, or the list, as JSON on standard output");
}

}  // namespace welkin
