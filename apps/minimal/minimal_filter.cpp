// One kernel of your choice at one size, as a picture: an environment seen by a glossy surface.
// Usage: minimal_filter [INPUT [ALPHA [OUTPUT.png]]]     ALPHA is the GGX width, 0 < ALPHA <= 1
#include <welkin/envmap/environment.h>
#include <welkin/envmap/filter.h>
#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/sphere/cube_layout.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) try {
  const char* input = argc > 1 ? argv[1] : "sky:studio,size=512x256";
  const double alpha = argc > 2 ? std::atof(argv[2]) : 0.25;
  const char* output = argc > 3 ? argv[3] : "filtered.png";

  const welkin::Environment environment = welkin::load_environment(input);

  // Any number of kernels and sizes can be made at once: they share the map's spectrum.
  const std::vector<welkin::FilterTarget> targets = {{welkin::make_ggx_kernel(alpha), 64}};
  const std::vector<welkin::Cube> cubes = welkin::filter_environment(environment.radiance, targets);

  welkin::save_image(output, welkin::cube_to_layout(cubes[0], welkin::CubeLayout::horizontal_cross));
  std::printf("%s: %s\n", output, welkin::describe(targets[0].kernel).c_str());
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_filter: %s\n", error.what());
  return 1;
}
