#include "measure.h"

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/built_in.h>

// Environments sampled per pixel in OpenGL: the error of every strategy after 1, 16, 64 and 256 samples, and what a sample costs beside
// one of the material's directions alone. Usage: bench_importance_gl [FILE ...]

namespace {

using namespace welkin;

constexpr int width = 60, height = 40, reference_samples = 2048;
constexpr int sample_counts[] = {1, 16, 64, 256};

struct Strategy {
  const char* name;
  const char* choice;
};
constexpr Strategy strategies[] = {
    {"BRDF", "importance:sampling=brdf"},
    {"environment, CDFs", "importance:sampling=environment"},
    {"environment, alias", "importance:sampling=environment,table=alias"},
    {"environment, rows added up", "importance:sampling=environment,table=rows"},
    {"environment, CDFs, lecture's density", "importance:sampling=environment,jacobian=lecture"},
    {"both (MIS), CDFs", "importance:sampling=mis"},
    {"both (MIS), alias", "importance:sampling=mis,table=alias"},
    {"both (MIS), CDFs, lecture's density", "importance:sampling=mis,jacobian=lecture"},
};
constexpr int brdf = 0, mis = 5;

Image drawn(Renderer& renderer, const std::string& choice, int frames) {
  const TechniqueChoice chosen = parse_technique(choice);
  renderer.set_technique(*chosen.technique, chosen.values);
  for (int i = 0; i < frames; ++i) renderer.draw();
  return renderer.read_picture();
}

Image sampled(Renderer& renderer, const std::string& choice, int samples) {
  const int each = std::min(samples, 64);
  return drawn(renderer, fmt::format("{},samples={}", choice, each), samples / each);
}

struct Difference {
  double rms = 0, bias = 0;  // over the mean of the reference
};

Difference difference(const Image& picture, const Image& reference) {
  double squares = 0, sum = 0, mean = 0;
  int surfaces = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); i += 4) {
    if (reference.pixels[i + 3] == 0) continue;
    ++surfaces;
    for (std::size_t c = i; c < i + 3; ++c) {
      const double off = double{picture.pixels[c]} - reference.pixels[c];
      squares += off * off / 3;
      sum += off / 3;
      mean += reference.pixels[c] / 3;
    }
  }
  return {std::sqrt(squares / surfaces) / (mean / surfaces), sum / mean};
}

// Seconds of a frame of 16 samples.
double frame_seconds(Renderer& renderer, const std::string& choice) {
  const TechniqueChoice chosen = parse_technique(choice + ",samples=16");
  renderer.set_technique(*chosen.technique, chosen.values);
  return bench::measure(5,
                        [&] {
                          renderer.draw();
                          renderer.read_picture();
                        })
      .median;
}

void bench_map(bench::Report& report, Renderer& renderer, const std::string& source) {
  Image map = load_environment(source).radiance;
  report.note(fmt::format("-- {} ({} x {}), built-in scene spheres, {} x {} pixels", source, map.width,
                          map.height, width, height));
  IblOptions options;
  options.size = 128;
  renderer.set_environment(make_environment_data(std::move(map), options));
  const Image reference =
      sampled(renderer, std::string(strategies[mis].choice) + ",seed=1", reference_samples);
  const double base = frame_seconds(renderer, strategies[brdf].choice);
  report.note(fmt::format("{:<38} {:>8} {:>8} {:>8} {:>8}   time", "RMS error / mean of the truth, samples",
                          1, 16, 64, 256));
  for (const Strategy& strategy : strategies) {
    std::string line = fmt::format("{:<38}", strategy.name);
    double bias = 0;
    for (const int samples : sample_counts) {
      const Difference d = difference(sampled(renderer, strategy.choice, samples), reference);
      line += fmt::format(" {:>8.4f}", d.rms);
      bias = std::abs(d.bias);
    }
    report.note(fmt::format("{}   {:.2f} x BRDF", line, frame_seconds(renderer, strategy.choice) / base));
    // Directions of the material alone find a sun so rarely that 256 of them say nothing about the mean.
    if (&strategy != &strategies[brdf]) report.check("  mean against the reference", bias, 0.02);
  }
  for (const int samples : {4, 16, 64}) {
    const std::string choice = fmt::format("filtered-importance:samples={}", samples);
    const Difference d = difference(drawn(renderer, choice, 1), reference);
    report.note(fmt::format("filtered-importance, {:>2} look-ups        {:>8.4f}", samples, d.rms));
  }
  report.note(fmt::format("prefiltered-ggx                        {:>8.4f}",
                          difference(drawn(renderer, "prefiltered-ggx", 1), reference).rms));
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  const HeadlessContext context;
  Renderer renderer({TexelFormat::rgba32f, TexelFormat::rgba16f});
  const Scene scene = make_built_in_scene("spheres");
  renderer.set_technique(find_technique("importance"), initial_values(find_technique("importance")));
  renderer.set_camera(scene.cameras[0]);
  renderer.set_scene(scene);
  renderer.resize(width, height);
  for (const char* sky : {"sky:day,size=128x64", "sky:studio,size=128x64"})
    bench_map(report, renderer, sky);
  for (int i = 1; i < argc; ++i) bench_map(report, renderer, argv[i]);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_importance_gl: {}\n", error.what());
  return 1;
}
