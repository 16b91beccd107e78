#include <chrono>
#include <cstddef>
#include <cstdio>

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/sky/sky.h>

// What make_ibl makes of the built-in sky, as numbers one a line; compiled for the machine and for the browser, whose
// numbers are compared (numbers.test.mjs). The seconds go to stderr.

int main() {
  using namespace welkin;
  const auto begin = std::chrono::steady_clock::now();
  const Image sky = make_sky({});
  const auto made = std::chrono::steady_clock::now();
  IblOptions options;
  options.size = 128;
  options.irradiance_size = 32;
  options.dfg_size = 32;
  const IblSet maps = make_ibl(sky, options);
  const auto filtered = std::chrono::steady_clock::now();
  const auto print = [](double value) { std::printf("%.9g\n", value); };
  for (double c : maps.radiance_sh.values) print(c);
  for (float v : maps.irradiance.texels) print(static_cast<double>(v));
  for (const Cube& level : maps.specular.levels)
    for (std::size_t i = 0; i < level.texels.size(); i += 37) print(static_cast<double>(level.texels[i]));
  const std::chrono::duration<double> sky_time = made - begin, filter_time = filtered - made;
  std::fprintf(stderr, "sky %.3f s, make_ibl %.3f s\n", sky_time.count(), filter_time.count());
}
