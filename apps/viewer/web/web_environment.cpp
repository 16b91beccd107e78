#include <algorithm>
#include <string_view>

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/realtime/renderer.h>

#include "packed_light.h"
#include "web_calls.h"

// Called in the worker: from a file's bytes, from pixels or from a sky's name to packed maps.

// clang-format off
EM_JS(void, report_progress, (double share), { if (Module.onProgress) Module.onProgress(share); });
// clang-format on

namespace welkin {
namespace {

std::vector<std::uint8_t> packed;

// Texels of the radiance that are kept for techniques that sample it: no more than a phone can hold twice.
constexpr int largest_width = 4096;

void filter(Environment environment, int size) {
  if (environment.radiance.width > largest_width)
    throw Error(environment.source, "has more than 4096 columns; make it smaller first");
  IblOptions options;
  options.size = size;
  options.irradiance_size = std::min(size, 64);
  options.filter.progress = [](double share) { report_progress(share); };
  packed = pack_light(*make_environment_data(std::move(environment.radiance), options));
}

}  // namespace
}  // namespace welkin

extern "C" {

/// A sky, "sky:..." as `welkin sky` has it, into maps of `size` texels.
EMSCRIPTEN_KEEPALIVE int welkin_filter_sky(const char* name, int size) {
  return welkin::succeeds([&] { welkin::filter(welkin::load_environment(name), size); });
}

/// The bytes of a .hdr, .ktx2 or .dds file.
EMSCRIPTEN_KEEPALIVE int welkin_filter_file(const unsigned char* bytes, int count, const char* name,
                                            int size) {
  return welkin::succeeds([&] {
    const std::span file(bytes, static_cast<std::size_t>(count));
    welkin::filter(welkin::make_environment(welkin::decode_image(file, name), name), size);
  });
}

/// width * height * 3 floats, linear, row 0 the top: what JavaScript decoded.
EMSCRIPTEN_KEEPALIVE int welkin_filter_pixels(const float* rgb, int width, int height, const char* name,
                                              int size) {
  return welkin::succeeds([&] {
    welkin::LoadedImage loaded;
    loaded.flat = welkin::Image(width, height);
    std::copy_n(rgb, loaded.flat.pixels.size(), loaded.flat.pixels.begin());
    loaded.format = "pixels";
    welkin::filter(welkin::make_environment(std::move(loaded), name), size);
  });
}

/// Where the packed maps of the last of these calls are.
EMSCRIPTEN_KEEPALIVE const unsigned char* welkin_packed() { return welkin::packed.data(); }
EMSCRIPTEN_KEEPALIVE int welkin_packed_size() { return static_cast<int>(welkin::packed.size()); }
}
