// From one layout of the sphere to another, without losing light.
// Usage: minimal_convert [INPUT [OUTPUT.hdr]]
#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/sphere/resample.h>

#include <cstdio>
#include <utility>

int main(int argc, char** argv) try {
  const char* input = argc > 1 ? argv[1] : "sky:day,size=512x256";
  const char* output = argc > 2 ? argv[2] : "octahedral.hdr";

  welkin::Environment environment = welkin::load_environment(input);
  const welkin::SphereMap source{welkin::Mapping::equirectangular, std::move(environment.radiance)};
  const welkin::SphereMap target =
      welkin::resample(source, welkin::map_shape(welkin::Mapping::octahedral, 256));

  // Radiance times solid angle over all texels: what went in comes out.
  const double before = welkin::map_energy(source)[1], after = welkin::map_energy(target)[1];
  welkin::save_image(output, target.image);
  std::printf("%s: %d x %d, green energy %.6g before, %.6g after\n", output, target.image.width,
              target.image.height, before, after);
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_convert: %s\n", error.what());
  return 1;
}
