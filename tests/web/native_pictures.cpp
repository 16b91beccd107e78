#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <welkin/envmap/environment.h>
#include <welkin/image/output_file.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/viewer/viewer.h>
#include <welkin/scene/built_in.h>

// native_pictures SCENE PICTURE_SIZE MAP_SIZE FOLDER: one frame of each technique, lit by the built-in sky, as the bytes
// that the page's viewer would show in the same state: FOLDER/<technique>.rgb.

int main(int count, char** arguments) {
  using namespace welkin;
  if (count != 5) return 2;
  const int size = std::atoi(arguments[2]);
  const std::string folder = arguments[4];
  try {
    const HeadlessContext context;
    Viewer viewer;
    IblOptions options;
    options.size = std::atoi(arguments[3]);
    options.irradiance_size = std::min(options.size, 64);
    viewer.set_environment(make_environment_data(load_environment("sky:").radiance, options));
    viewer.set_scene(make_built_in_scene(arguments[1]));
    viewer.resize(size, size);
    for (const TechniqueInfo& technique : techniques()) {
      viewer.state.technique = parse_technique(technique.name);
      viewer.draw();
      write_file(folder + "/" + std::string(technique.name) + ".rgb", viewer.screenshot().pixels);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "native_pictures: %s\n", error.what());
    return 1;
  }
}
