#include <algorithm>
#include <cstring>
#include <functional>

#include "measure.h"

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/range_fit.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/resample.h>

// Files in memory: encode and decode in MB/s of the floats that go in (12 bytes a pixel), against copying them. The
// error is the largest of a channel over the largest channel of its pixel.

namespace {

using namespace welkin;

using Bytes = std::vector<std::uint8_t>;

// Half floats and rgb9e5 keep their digits only above their smallest normal number, 6e-5 times the scale that the sun
// makes necessary: darker pixels do not count.
double largest_error(const std::vector<float>& a, const std::vector<float>& truth, double scale) {
  if (a.size() != truth.size()) return 1;
  double largest = 0;
  for (std::size_t i = 0; i < truth.size(); i += 3) {
    const double pixel = std::max({truth[i], truth[i + 1], truth[i + 2]});
    for (std::size_t c = i; c < i + 3; ++c)
      if (pixel > 1e-4 * scale)
        largest = std::max(largest, std::abs(static_cast<double>(a[c]) - truth[c]) / pixel);
  }
  return largest;
}

std::vector<float> pixels_of(const CubeMips& cube) {
  std::vector<float> all;
  for (const Cube& level : cube.levels) all.insert(all.end(), level.texels.begin(), level.texels.end());
  return all;
}

struct Codec {
  std::string name;
  double limit;  // of the error: half a unit of the last place where the mantissa is smallest
  std::function<Bytes()> encode;
  std::function<std::vector<float>(const Bytes&)> decode;
};

void bench_codec(bench::Report& report, const Codec& codec, const std::vector<float>& truth, double copy) {
  const Bytes bytes = codec.encode();
  const double scale = choose_scale(truth, PixelFormat::rgba16f, RangePolicy::scale).stored_scale;
  const double error = largest_error(codec.decode(bytes), truth, scale);
  const double megabytes = static_cast<double>(truth.size()) * 4e-6;
  const auto figure = [&](const std::string& what, bench::Timing time) {
    report.figure(
        what, time, error, codec.limit,
        fmt::format("{:>5.0f} MB/s, copy {:.0f} MB/s; {:.1f} bytes a pixel", megabytes / time.best, copy,
                    static_cast<double>(bytes.size()) / (static_cast<double>(truth.size()) / 3)));
  };
  figure(codec.name + " encode", bench::measure(3, [&] { codec.encode(); }));
  figure(codec.name + " decode", bench::measure(3, [&] { codec.decode(bytes); }));
}

double copy_rate(const std::vector<float>& values) {  // MB/s
  std::vector<float> copy(values.size());
  const bench::Timing time =
      bench::measure(5, [&] { std::memcpy(copy.data(), values.data(), values.size() * 4); });
  return static_cast<double>(values.size()) * 4e-6 / time.best;
}

std::vector<Codec> flat_codecs(const Image& image) {
  const auto flat = [](LoadedImage&& loaded) { return std::move(loaded.flat.pixels); };
  const double scale = choose_scale(image.pixels, PixelFormat::rgba16f, RangePolicy::scale).stored_scale;
  return {
      {"hdr", 1.0 / 255, [&image] { return encode_hdr(image); },
       [](const Bytes& b) { return decode_hdr(b, "hdr").pixels; }},
      {"exr half", 1.0 / 2048,
       [&image, scale] {
         return encode_exr(image, {ExrPixelType::half_float, scale});
       },
       [flat](const Bytes& b) { return flat(decode_exr(b, "exr")); }},
      {"exr float", 0,
       [&] {
         return encode_exr(image, {ExrPixelType::single_float, 1});
       },
       [flat](const Bytes& b) { return flat(decode_exr(b, "exr")); }},
  };
}

std::vector<Codec> cube_codecs(const CubeMips& cube) {
  std::vector<Codec> codecs;
  const auto add = [&](const std::string& name, double limit, PixelFormat format, int zstd) {
    Ktx2Options options;
    options.format = format;
    options.zstd_level = zstd;
    codecs.push_back({"ktx2 " + name, limit, [&cube, options] { return encode_ktx2(cube, options).bytes; },
                      [](const Bytes& b) { return pixels_of(decode_ktx2(b, "ktx2").cube); }});
  };
  add("rgba16f", 1.0 / 2048, PixelFormat::rgba16f, 0);
  add("rgba16f zstd 3", 1.0 / 2048, PixelFormat::rgba16f, 3);
  add("rgba32f", 0, PixelFormat::rgba32f, 0);
  add("rgb9e5", 1.0 / 511, PixelFormat::rgb9e5, 0);
  const double scale = encode_dds(cube).stored_scale;  // not in the file
  codecs.push_back({"dds rgba16f", 1.0 / 2048, [&cube] { return encode_dds(cube).bytes; },
                    [scale](const Bytes& b) {
                      std::vector<float> pixels = pixels_of(decode_dds(b, "dds").cube);
                      for (float& p : pixels) p = static_cast<float>(scale * p);
                      return pixels;
                    }});
  return codecs;
}

}  // namespace

int main() try {
  bench::Report report;
  const Image sky = make_sky(parse_sky("sky:day,size=2048x1024"));
  const double copy = copy_rate(sky.pixels);
  report.note("-- a flat map of 2048 x 1024");
  for (const Codec& codec : flat_codecs(sky)) bench_codec(report, codec, sky.pixels, copy);
  const CubeMips cube = build_mips(equirect_to_cube(sky, 512));
  const std::vector<float> texels = pixels_of(cube);
  report.note("-- a cube of 512 with all levels");
  for (const Codec& codec : cube_codecs(cube)) bench_codec(report, codec, texels, copy);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_codecs: {}\n", error.what());
  return 1;
}
