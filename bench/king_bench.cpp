#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "measure.h"

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/realtime/capture/glossy_maps.h>
#include <welkin/realtime/capture/lobe_cube.h>
#include <welkin/realtime/capture/sh_projector.h>
#include <welkin/realtime/capture/sphere_capture.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/renderer.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/folded_lookup.h>
#include <welkin/sh/map_projection.h>
#include <welkin/sphere/cube.h>

// Light that is captured each frame, in OpenGL: King's (2005) loop, a 64 x 64 x 6 cube to nine coefficients and back to 32 x 32 x 6 irradiance, which took a GeForce 6800
// 1/300 s; the captures; and glossy maps, each with its error. Times are of the clock around glFinish.

namespace {

using namespace welkin;

constexpr int radiance_size = 64, irradiance_size = 32;
constexpr double pi = std::numbers::pi;

template <class Work>
bench::Timing gl_time(int runs, int calls, Work&& work) {
  glFinish();
  bench::Timing time = bench::measure(runs, [&] {
    for (int i = 0; i < calls; ++i) work();
    glFinish();
  });
  return {time.best / calls, time.median / calls};
}

const Bounds unit_box{{-1, -1, -1}, {1, 1, 1}};

struct Stage {
  GpuEnvironment environment;
  Fullscreen fullscreen;
  Surroundings room;

  explicit Stage(const EnvironmentData& light)
      : environment(upload_environment(light.maps)), room(SurroundingsKind::room, unit_box, 8) {
    room.move_to(1.3, 150);
  }

  void capture(SphereCapture& capture) const {
    CaptureSky sky;
    sky.environment = &environment;
    capture.capture(room, sky, CaptureAmbient(), fullscreen);
  }
};

// Each texel copied by a fragment program.
bench::Timing copy_time(const GlTexture& cube, int size, const Fullscreen& fullscreen) {
  TextureDesc desc;
  desc.width = size;
  const GlTexture to = make_cube_texture(desc);
  const GlFramebuffer framebuffer = GlFramebuffer::make();
  const Program program("fullscreen.vert", "glossy_picture.frag");
  return gl_time(11, 5, [&] {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, size, size);
    program.use();
    program.set_texture("cube", 10, GL_TEXTURE_CUBE_MAP, cube);
    program.set("size", static_cast<float>(size));
    program.set("reach", 1.0f);
    for (int face = 0; face < 6; ++face) {
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                             GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), to.name(), 0);
      program.set("layer", face);
      fullscreen.draw();
    }
  });
}

double relative_error(const std::vector<double>& values, const std::vector<double>& truth) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    largest = std::max(largest, std::abs(truth[i]));
    difference = std::max(difference, std::abs(values[i] - truth[i]));
  }
  return difference / largest;
}

void bench_loop(bench::Report& report, const Stage& stage, CaptureInput input, const char* name) {
  SphereCapture capture(input, radiance_size);
  stage.capture(capture);
  const SphereMap map = capture.read_map();
  const ShCoefficients truth = project_map(map, 2);
  const LobeCube lobe(irradiance_size, cosine_lobe(2));
  SphereCapture copied(CaptureInput::cube, radiance_size);
  stage.capture(copied);
  const double copy = copy_time(copied.cube(), radiance_size, stage.fullscreen).median;
  report.note(
      fmt::format("-- King's loop from {}; a copy of 64 x 64 x 6 texels takes {:.0f} us", name, 1e6 * copy));
  for (const auto& [method, label] : {std::pair{ShProjectionMethod::tiled, "tiled pass (King 2005)"},
                                      std::pair{ShProjectionMethod::staged, "staged passes"},
                                      std::pair{ShProjectionMethod::compute, "compute"}}) {
    if (method == ShProjectionMethod::compute && !has_compute()) continue;
    const ShProjector projector(capture.shape(), 2, method);
    const auto project = [&] { projector.project(capture.map(), stage.fullscreen); };
    const auto whole = [&] {
      project();
      lobe.draw(projector.coefficients(), stage.fullscreen);
    };
    const bench::Timing part = gl_time(11, 3, project), time = gl_time(11, 3, whole);
    report.figure(
        label, time, relative_error(projector.read().values, truth.values), 1e-5,
        fmt::format("projection alone {:.2f} ms; loop {:.1f} copies", 1e3 * part.median, time.median / copy));
  }
  const auto table = make_sh_projection_table(map.shape(), 2, 3, TexelRule::integrated);
  ShCoefficients result;
  bench::Timing cpu = bench::measure(101, [&] {
    for (int i = 0; i < 10; ++i) project(table, map, result);
  });
  cpu = {cpu.best / 10, cpu.median / 10};
  report.figure("processor, folded table, no upload", cpu, relative_error(result.values, truth.values), 1e-5,
                fmt::format("{:.1f} us; {:.2f} copies", 1e6 * cpu.median, cpu.median / copy));
}

void bench_captures(bench::Report& report, const EnvironmentData& light) {
  report.note(
      "-- Capturing the room with four flares; the warped paraboloids' relative RMS beside the exact ones "
      "(radiance cut at 2)");
  for (const int patches : {1, 2, 4, 8, 16}) {
    Stage stage(light);
    stage.room = Surroundings(SurroundingsKind::room, unit_box, patches);
    stage.room.move_to(1.3, 150);
    SphereCapture cube(CaptureInput::paraboloid, radiance_size),
        warped(CaptureInput::paraboloid_warped, radiance_size);
    // Errors at four times the size, where texels on edges count little.
    const auto captured = [&stage](CaptureInput input) {
      SphereCapture fine(input, 4 * radiance_size);
      stage.capture(fine);
      return fine.read_map();
    };
    const SphereMap truth = captured(CaptureInput::paraboloid),
                    map = captured(CaptureInput::paraboloid_warped);
    double error = 0, sum = 0;
    for (int i = 0; i < truth.image.width * truth.image.height; ++i) {
      const int x = i % truth.image.width, y = i / truth.image.width;
      if (!map_covers(truth.shape(), x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const double a = static_cast<double>(std::min(truth.image.at(x, y)[c], 2.0f)),
                     b = static_cast<double>(std::min(map.image.at(x, y)[c], 2.0f));
        error += (a - b) * (a - b);
        sum += a * a;
      }
    }
    const ShCoefficients exact = project_map(truth, 2), of_warped = project_map(map, 2);
    const bench::Timing six = gl_time(7, 1, [&] { stage.capture(cube); });
    const bench::Timing two = gl_time(7, 1, [&] { stage.capture(warped); });
    report.note(
        fmt::format("{:>2} x {:<2} patches a wall: cube + resampling {:5.2f} ms, warped {:5.2f} ms, RMS "
                    "{:.3f}, coefficients {:.1e}",
                    patches, patches, 1e3 * six.median, 1e3 * two.median, std::sqrt(error / sum),
                    relative_error(of_warped.values, exact.values)));
  }
}

struct Light {
  Vec3 direction;
  double weight;
  std::array<double, 3> radiance;
};

// The texels in 2 x 2 parts: the narrowest lobe here is as wide as eight of those.
std::vector<Light> lights_of(const Cube& cube) {
  std::vector<Light> lights;
  const int n = 2 * cube.size;
  for (int i = 0; i < 6 * n * n; ++i) {
    const int face = i / (n * n), y = i / n % n, x = i % n;
    const float* texel = cube.at(face, x / 2, y / 2);
    lights.push_back(
        {cube_texel_direction(n, face, x, y),
         cube_texel_solid_angle(n, x, y),
         {static_cast<double>(texel[0]), static_cast<double>(texel[1]), static_cast<double>(texel[2])}});
  }
  return lights;
}

constexpr int probe_size = 8, probe_step = 5, glossy_size = 128;

std::vector<double> filtered_truth(const Cube& cube, double perceptual_roughness) {
  const ZonalKernel kernel = make_ggx_kernel(perceptual_roughness * perceptual_roughness);
  const std::vector<Light> lights = lights_of(cube);
  std::vector<double> u(lights.size()), k(lights.size()), truth;
  for (int i = 0; i < 6 * probe_size * probe_size; i += probe_step) {
    const Vec3 axis = cube_texel_direction(probe_size, i / (probe_size * probe_size), i % probe_size,
                                           i / probe_size % probe_size);
    for (std::size_t j = 0; j < lights.size(); ++j) u[j] = std::max(0.0, 1 - dot(axis, lights[j].direction));
    evaluate(kernel, u, k);
    std::array<double, 3> sum{};
    double weight = 0;
    for (std::size_t j = 0; j < lights.size(); ++j) {
      if (k[j] == 0) continue;
      const double w = k[j] * lights[j].weight;
      weight += w;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += w * lights[j].radiance[c];
    }
    for (const double value : sum) truth.push_back(value / weight);
  }
  return truth;
}

class Probe {
 public:
  std::vector<double> filtered(const GlossyMaps& maps, const GlTexture& cube, float roughness,
                               const Fullscreen& fullscreen) {
    TextureDesc desc;
    desc.width = probe_size;
    desc.format = TexelFormat::rgba32f;
    desc.linear = false;
    const GlTexture target = make_cube_texture(desc);
    const GlFramebuffer framebuffer = GlFramebuffer::make();
    program_.use();
    maps.set(program_, cube);
    program_.set("size", static_cast<float>(probe_size));
    program_.set("perceptual_roughness", roughness);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, probe_size, probe_size);
    for (int face = 0; face < 6; ++face) {
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                             GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), target.name(), 0);
      program_.set("face", face);
      fullscreen.draw();
    }
    const Cube result = read_cube(target, probe_size, 0);
    std::vector<double> values;
    for (int i = 0; i < 6 * probe_size * probe_size; i += probe_step)
      for (std::size_t c = 0; c < 3; ++c)
        values.push_back(static_cast<double>(result.texels[3 * static_cast<std::size_t>(i) + c]));
    return values;
  }

 private:
  Program program_{"fullscreen.vert", "glossy_probe.frag"};
};

double relative_rms(const std::vector<double>& values, const std::vector<double>& truth) {
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    error += (values[i] - truth[i]) * (values[i] - truth[i]);
    sum += truth[i] * truth[i];
  }
  return std::sqrt(error / sum);
}

struct GlossyCase {
  const char* name;
  GlossyOptions options;
};

void bench_glossy(bench::Report& report, const Stage& stage, const char* what, bool bare) {
  const GlossyCase cases[] = {
      {"box, faces alone", {GlossyMethod::box, true, 16, glossy_size}},
      {"box, seamless", {GlossyMethod::box, false, 16, glossy_size}},
      {"bordered", {GlossyMethod::bordered, false, 16, glossy_size}},
      {"paraboloid, no border", {GlossyMethod::paraboloid, true, 16, glossy_size}},
      {"paraboloid", {GlossyMethod::paraboloid, false, 16, glossy_size}},
      {"importance, 8", {GlossyMethod::importance, false, 8, glossy_size}},
      {"importance, 16", {GlossyMethod::importance, false, 16, glossy_size}},
      {"importance, 32", {GlossyMethod::importance, false, 32, glossy_size}},
      {"quick, 8", {GlossyMethod::quick, false, 8, glossy_size}},
      {"quick, 16", {GlossyMethod::quick, false, 16, glossy_size}},
      {"quick, 32", {GlossyMethod::quick, false, 32, glossy_size}},
  };
  constexpr double roughnesses[] = {0.25, 0.375, 0.5, 0.75, 1};
  const Surroundings nothing(SurroundingsKind::none, unit_box, 1);
  SphereCapture capture(CaptureInput::cube, glossy_size);
  CaptureSky sky;
  sky.environment = &stage.environment;
  capture.capture(bare ? nothing : stage.room, sky, CaptureAmbient(), stage.fullscreen);
  const Cube radiance = capture.read_as_cube();
  std::vector<std::vector<double>> truths;
  for (const double roughness : roughnesses) truths.push_back(filtered_truth(radiance, roughness));
  const double copy = copy_time(capture.cube(), glossy_size, stage.fullscreen).median;
  report.note(
      fmt::format("-- Glossy maps of {}, 128 x 128 x 6: time of a frame's filtering and relative RMS at "
                  "roughness 0.25 0.375 0.5 0.75 1",
                  what));
  Probe probe;
  for (const GlossyCase& at : cases) {
    GlossyMaps maps(at.options);
    maps.update(capture.cube(), stage.fullscreen);
    std::string line;
    for (std::size_t i = 0; i < truths.size(); ++i)
      line += fmt::format(
          " {:.3f}", relative_rms(probe.filtered(maps, capture.cube(), static_cast<float>(roughnesses[i]),
                                                 stage.fullscreen),
                                  truths[i]));
    const bench::Timing time = gl_time(5, 2, [&] { maps.update(capture.cube(), stage.fullscreen); });
    report.note(fmt::format("{:<24} {:7.2f} ms {:6.1f} copies  {}", at.name, 1e3 * time.median,
                            time.median / copy, line));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  const HeadlessContext context;
  report.note(fmt::format("driver: {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER))));
  IblOptions options;
  options.size = 128;
  const Environment source = load_environment(argc > 1 ? argv[1] : "sky:studio,size=256x128");
  const auto light = make_environment_data(source.radiance, options);
  const Stage stage(*light);
  bench_loop(report, stage, CaptureInput::cube, "a cube");
  bench_loop(report, stage, CaptureInput::paraboloid, "two paraboloids of 64");
  bench_captures(report, *light);
  bench_glossy(report, stage, "a room with flares", false);
  bench_glossy(report, stage, argc > 1 ? argv[1] : "a studio", true);
  return report.exit_code();
} catch (const Error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
