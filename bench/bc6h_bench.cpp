#include <algorithm>
#include <cstring>

#include "measure.h"

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/image/codecs/bc6h/cube_edges.h>
#include <welkin/image/half.h>
#include <welkin/image/load.h>
#include <welkin/image/packed_formats.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/resample.h>

// BC6H on one core: Mtexel/s and RMSLE (root mean square of the difference of log(1 + x), all channels) of the three
// speeds against the same map in half floats; beside it rgb9e5 and a copy of the floats. Checked before: no block is
// brighter than its input. Then cubes: the largest step between texels that share an edge, coded apart and shared.
// Usage: bench_bc6h [FILE ...]

namespace {

using namespace welkin;

constexpr Bc6hSpeed speeds[] = {Bc6hSpeed::fast, Bc6hSpeed::normal, Bc6hSpeed::high};
constexpr const char* speed_names[] = {"fast", "normal", "high"};

double log_step(float a, float b) {
  return std::log1p(static_cast<double>(a)) - std::log1p(static_cast<double>(b));
}

double rmsle(const std::vector<float>& a, const std::vector<float>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += log_step(a[i], truth[i]) * log_step(a[i], truth[i]);
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

// How many channels of blocks hold something above the block's largest input.
int brighter_channels(const Image& image, const std::vector<float>& back) {
  int count = 0;
  for (int y0 = 0; y0 < image.height; y0 += 4) {
    for (int x0 = 0; x0 < image.width; x0 += 4) {
      for (std::size_t c = 0; c < 3; ++c) {
        float most = 0, got = 0;
        for (int y = y0; y < std::min(y0 + 4, image.height); ++y) {
          for (int x = x0; x < std::min(x0 + 4, image.width); ++x) {
            const std::size_t i = (static_cast<std::size_t>(y) * image.width + x) * 3 + c;
            most = std::max(most, image.pixels[i]), got = std::max(got, back[i]);
          }
        }
        count += got > most ? 1 : 0;
      }
    }
  }
  return count;
}

double relative_rms(const std::vector<float>& a, const std::vector<float>& truth) {
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t = truth[i], d = a[i] - t;
    error += d * d, norm += t * t;
  }
  return std::sqrt(error / norm);
}

// What counting bright texels by their energy costs in RMSLE and wins in linear error.
void bench_linear(bench::Report& report, const Image& image) {
  std::vector<std::uint8_t> blocks(bc6h_bytes(image.width, image.height));
  std::vector<float> back(image.pixels.size());
  double mean = 0;
  for (const float p : image.pixels)
    mean += static_cast<double>(p) / static_cast<double>(image.pixels.size());
  for (const double linear_above : {0.0, 16 * mean}) {
    const double seconds = bench::seconds_of([&] {
      encode_bc6h(image.pixels, image.width, image.height, 3, 1,
                  {.speed = Bc6hSpeed::normal, .linear_above = linear_above}, blocks);
    });
    decode_bc6h(blocks, image.width, image.height, false, 1, back);
    report.figure(linear_above > 0 ? "normal, linear above 16 means" : "normal, logarithmic",
                  bench::timing_of({seconds}), rmsle(back, image.pixels), 0.05,
                  fmt::format("relative RMS {:.1e}", relative_rms(back, image.pixels)));
  }
}

void bench_map(bench::Report& report, const std::string& name, Image image) {
  for (float& p : image.pixels) {
    std::size_t clipped = 0;
    p = std::abs(float_from_half(half_saturated(std::max(p, 0.0f), clipped)));
  }
  const double megatexels = static_cast<double>(image.pixels.size()) / 3e6;
  const auto rate = [&](double seconds) {
    return fmt::format("{:.2f} Mtexel/s a core", megatexels / seconds);
  };
  report.note(fmt::format("-- {}, {} x {}", name, image.width, image.height));
  std::vector<std::uint8_t> blocks(bc6h_bytes(image.width, image.height));
  std::vector<float> back(image.pixels.size());
  for (int s = 0; s < 3; ++s) {
    const auto encode = [&] {
      encode_bc6h(image.pixels, image.width, image.height, 3, 1, {.speed = speeds[s]}, blocks);
    };
    const bench::Timing time =
        s == 0 ? bench::measure(5, encode) : bench::timing_of({bench::seconds_of(encode)});
    decode_bc6h(blocks, image.width, image.height, false, 1, back);
    report.check(fmt::format("{} brighter", speed_names[s]), brighter_channels(image, back), 0);
    report.figure(fmt::format("bc6h {}", speed_names[s]), time, rmsle(back, image.pixels), 0.05,
                  rate(time.best));
  }
  const bench::Timing decode =
      bench::measure(5, [&] { decode_bc6h(blocks, image.width, image.height, false, 1, back); });
  bench_linear(report, image);
  report.figure("bc6h decode", decode, 0, 0, rate(decode.best));
  std::vector<std::uint8_t> words(image.pixels.size() / 3 * 4);
  const bench::Timing packed =
      bench::measure(5, [&] { encode_pixels(image.pixels, 3, 1, PixelFormat::rgb9e5, words); });
  decode_pixels(words, pixel_layout(PixelFormat::rgb9e5), 1, back);
  report.figure("rgb9e5 (yardstick)", packed, rmsle(back, image.pixels), 0.01, rate(packed.best));
  const bench::Timing copy =
      bench::measure(5, [&] { std::memcpy(back.data(), image.pixels.data(), image.pixels.size() * 4); });
  report.figure("copy (yardstick)", copy, 0, 0, rate(copy.best));
}

double largest_step(const Cube& cube) {
  double largest = 0;
  for (int face = 0; face < 6; ++face) {
    for (int side = 0; side < 4; ++side) {
      for (int k = 0; k < cube.size; ++k) {
        const bc6h::CubeTexel a = bc6h::on_side(cube.size, face, side, k);
        const bc6h::CubeTexel b = bc6h::across_edge(cube.size, face, side, k);
        for (int c = 0; c < 3; ++c) {
          largest = std::max(largest,
                             std::abs(log_step(cube.at(a.face, a.x, a.y)[c], cube.at(b.face, b.x, b.y)[c])));
        }
      }
    }
  }
  return largest;
}

// Texels that share an edge get their mean, as an edge fix-up leaves them (texels of corners take part in both edges).
void average_edges(Cube& cube) {
  for (int face = 0; face < 6; ++face) {
    for (int side = 0; side < 4; ++side) {
      for (int k = 1; k < cube.size - 1; ++k) {
        const bc6h::CubeTexel a = bc6h::on_side(cube.size, face, side, k);
        const bc6h::CubeTexel b = bc6h::across_edge(cube.size, face, side, k);
        for (int c = 0; c < 3; ++c) {
          float &here = cube.at(a.face, a.x, a.y)[c], &there = cube.at(b.face, b.x, b.y)[c];
          here = there = 0.5f * (here + there);
        }
      }
    }
  }
}

void bench_cube(bench::Report& report, const Image& map, int size) {
  Cube cube = equirect_to_cube(map, size);
  average_edges(cube);
  const std::size_t face_bytes = bc6h_bytes(size, size), values = cube.texels.size() / 6;
  std::vector<std::uint8_t> blocks(6 * face_bytes);
  for (bool shared : {false, true}) {
    const double seconds = bench::seconds_of([&] { encode_bc6h_cube(cube, 1, {}, shared, blocks); });
    Cube back(size);
    for (std::size_t f = 0; f < 6; ++f) {
      decode_bc6h(std::span(blocks).subspan(f * face_bytes, face_bytes), size, size, false, 1,
                  std::span(back.texels).subspan(f * values, values));
    }
    report.figure(fmt::format("cube of {}, edges {}", size, shared ? "shared" : "apart"),
                  bench::timing_of({seconds}), rmsle(back.texels, cube.texels), 0.05,
                  fmt::format("largest step over an edge {:.5f} in log(1 + x)", largest_step(back)));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  set_thread_count(1);
  bench::Report report;
  for (int i = 1; i < argc; ++i) {
    const Image map = load_image(argv[i]).flat;
    bench_map(report, argv[i], map);
    bench_cube(report, map, 256);
  }
  if (argc == 1) {
    const Image sky = make_sky(parse_sky("sky:day,size=512x256"));
    bench_map(report, "sky:day", sky);
    bench_cube(report, sky, 64);
  }
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_bc6h: {}\n", error.what());
  return 1;
}
