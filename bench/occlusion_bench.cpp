#include <fmt/format.h>

#include <array>
#include <cstring>

#include "measure.h"
#include "occlusion_truth.h"

#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>
#include <welkin/image/tonemap.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/occlusion/slice_occlusion.h>
#include <welkin/scene/built_in.h>

// Screen-space occlusion on five scenes with thin things, at 16 and 32 depth reads a pixel: root mean square error against ambient occlusion
// traced in the scene, and traced in the depth layer that the methods are given (of the thickness that they are told). Usage:
// bench_occlusion [PREFIX], which writes PREFIX-<scene>.png: the methods side by side, the truth of the layer and of the scene last.

namespace {

using namespace welkin;
using Method = OcclusionMethod;

constexpr int width = 192, height = 128;

struct Place {
  const char* scene;
  float radius, thickness;  // metres
};
constexpr Place places[] = {{"fences:rows=4,posts=20", 0.5f, 0.08f},
                            {"stairs", 0.5f, 0.1f},
                            {"cards", 0.35f, 0.05f},
                            {"box", 0.6f, 0.2f},
                            {"shader-ball", 0.6f, 0.15f}};
constexpr std::size_t place_count = std::size(places);

struct Entry {
  const char* name;
  Method method;
  float falloff, step_power, intensity;
};
// GTAO as XeGTAO sets it (far occluders fade over 0.615 of the radius), and two other fades; the bitmask with even steps as
// published, and with GTAO's.
constexpr Entry entries[] = {{"ssao-sphere", Method::sphere, 0, 2, 1},
                             {"ssao-hemisphere", Method::hemisphere, 0, 2, 1},
                             {"ssao-range", Method::hemisphere, 1, 2, 1},
                             {"alchemy", Method::alchemy, 0, 2, 1},
                             {"sao", Method::sao, 0, 2, 0.6f},
                             {"gtao", Method::gtao, 0.615f, 2, 1},
                             {"gtao, falloff 0.3", Method::gtao, 0.3f, 2, 1},
                             {"gtao, falloff 0", Method::gtao, 0, 2, 1},
                             {"visibility-bitmask", Method::visibility_bitmask, 0, 1, 1},
                             {"bitmask, steps squared", Method::visibility_bitmask, 0, 2, 1},
                             {"horizon-sectors", Method::horizon_sectors, 0, 2, 1}};
constexpr std::size_t entry_count = std::size(entries);
constexpr std::size_t gtao_entry = 5, bitmask_entry = 8, own_entry = 10;

OcclusionOptions options_of(const Entry& entry, const Place& place, int reads) {
  OcclusionOptions options;
  options.method = entry.method;
  options.radius_metres = place.radius;
  options.thickness_metres = place.thickness;
  options.falloff = entry.falloff;
  options.step_power = entry.step_power;
  options.intensity = entry.intensity;
  options.samples = reads;
  options.slices = 2;
  options.steps = reads / 4;
  return options;
}

struct Truths {
  Image scene, layer, depth;
  DepthLayer known;
};

double rms(const Image& openness, const Image& truth, const Image& depth) {
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (depth.pixels[4 * i] <= 0) continue;
    const double error =
        openness.pixels[static_cast<std::size_t>(openness.channels) * (i + 1) - 1] - truth.pixels[i];
    squares += error * error;
    ++count;
  }
  return std::sqrt(squares / count);
}

Image last_channel(const Image& image) {
  Image one(image.width, image.height, 1);
  for (std::size_t i = 0; i < one.pixels.size(); ++i)
    one.pixels[i] = image.pixels[static_cast<std::size_t>(image.channels) * (i + 1) - 1];
  return one;
}

// Root mean square error of the differences between neighbours, along x and y, where both are surface.
double gradient_error(const Image& openness, const Truths& truth) {
  double squares = 0;
  int count = 0;
  for (int y = 0; y + 1 < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
        if (*truth.depth.at(x, y) <= 0 || *truth.depth.at(x + dx, y + dy) <= 0) continue;
        const double wanted = *truth.layer.at(x + dx, y + dy) - *truth.layer.at(x, y);
        const double error = *openness.at(x + dx, y + dy) - *openness.at(x, y) - wanted;
        squares += error * error;
        ++count;
      }
    }
  }
  return std::sqrt(squares / count);
}

// The mean of the 4 x 4 pixels about each corner, as Mittring 2007 has it.
Image box_filtered(const Image& image) {
  Image out(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float sum = 0;
      for (int j = -2; j < 2; ++j)
        for (int i = -2; i < 2; ++i)
          sum += *image.at(std::clamp(x + i, 0, width - 1), std::clamp(y + j, 0, height - 1)) / 16;
      *out.at(x, y) = sum;
    }
  }
  return out;
}

struct Bench {
  bench::Report report;
  std::string prefix;
  std::array<std::array<double, place_count>, entry_count> scene_error{}, layer_error{}, raw_error{},
      milliseconds{};

  Fullscreen fullscreen;
  PassTimer timer;

  Image picture(ScreenOcclusion& occlusion, const GpuScene& scene, const View& view,
                const OcclusionOptions& options) {
    occlusion.draw(scene, view, options, fullscreen, timer);
    return read_pixels(occlusion.openness());
  }

  void time(ScreenOcclusion& occlusion, const GpuScene& scene, const View& view,
            const OcclusionOptions& options, double& milliseconds_found) {
    std::vector<double> found;
    timer.enabled = true;
    for (int run = 0; run < 3; ++run) {
      timer.begin_frame();
      occlusion.draw(scene, view, options, fullscreen, timer);
      for (const PassTime& pass : timer.passes())
        if (pass.name == "occlusion") found.push_back(pass.milliseconds);
    }
    timer.enabled = false;
    milliseconds_found = bench::timing_of(found).median;
  }

  void place(std::size_t p, int reads, const GpuScene& gpu, const View& view, ScreenOcclusion& occlusion,
             const Truths& truth, std::vector<Image>& tiles) {
    for (std::size_t e = 0; e < entry_count; ++e) {
      OcclusionOptions options = options_of(entries[e], places[p], reads);
      const Image filtered = picture(occlusion, gpu, view, options);
      if (reads == 16) tiles.push_back(last_channel(filtered));
      scene_error[e][p] = rms(filtered, truth.scene, truth.depth);
      layer_error[e][p] = rms(filtered, truth.layer, truth.depth);
      if (p == 0) time(occlusion, gpu, view, options, milliseconds[e][p]);
      options.denoise = false;
      const Image raw = picture(occlusion, gpu, view, options);
      raw_error[e][p] = rms(raw, truth.layer, truth.depth);
      if (e == own_entry) check_own(p, reads, last_channel(filtered), last_channel(raw), truth);
    }
  }

  void check_own(std::size_t p, int reads, const Image& filtered, const Image& raw, const Truths& truth) {
    const double gradient = gradient_error(filtered, truth), box = gradient_error(box_filtered(raw), truth);
    report.note(
        fmt::format("  {:<24} {} reads: gradient error {:.4f}, of a 4 x 4 box over the same {:.4f}: {:.2f}",
                    places[p].scene, reads, gradient, box, gradient / box));
    if (reads != 16) return;
    Image scalar;
    const OcclusionOptions options = options_of(entries[own_entry], places[p], reads);
    const bench::Timing timing = bench::measure(1, [&] { scalar = slice_occlusion(truth.known, options); });
    report.figure("  scalar form on the processor", timing, rms(scalar, raw, truth.depth), 0.02,
                  "against the shader");
  }
};

double geometric_mean(const std::array<double, place_count>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / place_count);
}

void print_table(Bench& b, const char* title,
                 const std::array<std::array<double, place_count>, entry_count>& errors) {
  b.report.note(fmt::format("{:<26}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>9}", title, "fences", "stairs",
                            "cards", "box", "ball", "mean", "/ own", "time"));
  const double own = geometric_mean(errors[own_entry]);
  for (std::size_t e = 0; e < entry_count; ++e) {
    std::string line = fmt::format("  {:<24}", entries[e].name);
    for (const double error : errors[e]) line += fmt::format("{:>9.4f}", error);
    line += fmt::format("{:>9.4f}{:>8.2f}{:>6.1f} ms", geometric_mean(errors[e]),
                        geometric_mean(errors[e]) / own, b.milliseconds[e][0]);
    b.report.note(line);
  }
}

// Errors of the own method over those of a yardstick, the worst of the scenes.
double worst_ratio(const Bench& b, std::size_t yardstick) {
  double worst = 0;
  for (std::size_t p = 0; p < place_count; ++p)
    worst = std::max(worst, b.layer_error[own_entry][p] / b.layer_error[yardstick][p]);
  return worst;
}

void write_tiles(const std::string& file, const std::vector<Image>& tiles) {
  constexpr int columns = 4;
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  Image sheet(columns * width, rows * height, 3);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const int left = static_cast<int>(t) % columns * width, top = static_cast<int>(t) / columns * height;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) std::fill_n(sheet.at(left + x, top + y), 3, *tiles[t].at(x, y));
  }
  ToneMapOptions tone;
  tone.curve = ToneCurve::clamp;
  write_file(file, encode_png(tone_map(sheet, tone)));
}

Truths find_truths(const Scene& scene, const Place& place, const GpuScene& gpu, const View& view, Bench& b) {
  ScreenOcclusion occlusion;
  occlusion.draw(gpu, view, {}, b.fullscreen, b.timer);
  Truths truth;
  const Image depth = read_pixels(occlusion.geometry().target(), 0);
  truth.depth = depth;
  truth.known = make_depth_layer(depth, read_pixels(occlusion.geometry().target(), 1), view);
  truth.scene = bench::traced_occlusion(scene, width, height, place.radius, 256);
  truth.layer = trace_depth_layer(truth.known, {place.radius, place.thickness, 192});
  return truth;
}

void run(Bench& b) {
  for (const int reads : {16, 32}) {
    for (std::size_t p = 0; p < place_count; ++p) {
      const Scene scene = make_built_in_scene(places[p].scene);
      const GpuScene gpu = upload_scene(scene);
      const View view = make_view(scene.cameras[0], width, height, gpu.bounds);
      static std::array<Truths, place_count> truths;
      if (truths[p].depth.empty()) truths[p] = find_truths(scene, places[p], gpu, view, b);
      ScreenOcclusion occlusion;
      std::vector<Image> tiles;
      b.place(p, reads, gpu, view, occlusion, truths[p], tiles);
      tiles.insert(tiles.end(), {truths[p].layer, truths[p].scene});
      const std::string name(places[p].scene, std::strcspn(places[p].scene, ":"));
      if (reads == 16 && !b.prefix.empty()) write_tiles(b.prefix + "-" + name + ".png", tiles);
    }
    print_table(b, fmt::format("{} reads, traced scene", reads).c_str(), b.scene_error);
    print_table(b, fmt::format("{} reads, traced layer", reads).c_str(), b.layer_error);
    print_table(b, fmt::format("{} reads, not denoised", reads).c_str(), b.raw_error);
    b.report.check("error over that of gtao, worst scene", worst_ratio(b, gtao_entry), 0.7);
    b.report.check("error over that of visibility-bitmask, worst scene", worst_ratio(b, bitmask_entry), 0.9);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const HeadlessContext context;
  Bench b;
  if (argc > 1) b.prefix = argv[1];
  run(b);
  return b.report.exit_code();
}
