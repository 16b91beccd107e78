#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure.h"

#include <welkin/brdf/dfg.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/ibl.h>
#include <welkin/envmap/stored_errors.h>
#include <welkin/error.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/sphere_points.h>

// What each texture format costs and what it does to a lit sphere: the same sphere is shaded from the decoded cubes and
// from those before compression. The yardstick of the errors is half float, of the times copying into it.
// Then the seams: what samplers that do not filter across faces see, with each fix-up, before and after compression.
// Usage: bench_compression [FILE...]

namespace {

using namespace welkin;

struct Storage {
  std::string name;
  PixelFormat format;
  BlockQuality quality = BlockQuality::normal;
};

const std::vector<Storage>& storages() {
  static const std::vector<Storage> all = {
      {"rgba16f", PixelFormat::rgba16f},
      {"rgb9e5", PixelFormat::rgb9e5},
      {"r11g11b10f", PixelFormat::r11g11b10f},
      {"bc6h fast", PixelFormat::bc6h, BlockQuality::fast},
      {"bc6h normal", PixelFormat::bc6h, BlockQuality::normal},
      {"bc6h high", PixelFormat::bc6h, BlockQuality::high},
      {"astc fast", PixelFormat::astc, BlockQuality::fast},
      {"astc normal", PixelFormat::astc, BlockQuality::normal},
      {"astc high", PixelFormat::astc, BlockQuality::high},
      {"astc6x6 normal", PixelFormat::astc6x6, BlockQuality::normal},
  };
  return all;
}

EncodedTexture encode(const CubeMips& cube, const Storage& storage, bool shared_edges = false) {
  Ktx2Options options;
  options.format = storage.format;
  options.quality = storage.quality;
  options.shared_edges = shared_edges;
  return encode_ktx2(cube, options);
}

CubeMips through(const CubeMips& cube, const Storage& storage, bool shared_edges = false) {
  return decode_ktx2(encode(cube, storage, shared_edges).bytes, storage.name).cube;
}

struct ErrorSum {
  double error = 0, norm = 0;
  void add(const float* value, const float* truth, double weight) {
    for (int c = 0; c < 3; ++c) {
      const double d = weight * (static_cast<double>(value[c]) - static_cast<double>(truth[c]));
      error += d * d;
      norm += weight * weight * static_cast<double>(truth[c]) * static_cast<double>(truth[c]);
    }
  }
  double relative() const { return norm > 0 ? std::sqrt(error / norm) : 0; }
};

struct SphereErrors {
  double mirror = 0, glossy = 0, matt = 0;
};

// The visible half of a sphere as a camera far on +Z sees it; every normal stands for as many pixels (their area is
// its cosine, hence the weight). Mirror: roughness 0; glossy: perceptual roughness 0.1 to 1 of a metal; matt: diffuse.
SphereErrors light_sphere(const IblSet& set, const CubeMips& specular, const Cube& irradiance) {
  ErrorSum mirror, glossy, matt;
  const int levels = static_cast<int>(specular.levels.size());
  float a[3], b[3];
  for (const Vec3 n : sphere_points(6000, 5)) {
    if (n.z <= 0) continue;
    const double pixels = std::sqrt(n.z);
    const Vec3 reflected = 2 * n.z * n - Vec3{0, 0, 1};
    look_up_cube(irradiance, n, a);
    look_up_cube(set.irradiance, n, b);
    matt.add(a, b, pixels);
    for (int i = 0; i <= 10; ++i) {
      const double r = 0.1 * i;
      const DfgValue dfg = look_up_dfg(set.dfg, n.z, r);
      const double level = perceptual_roughness_to_level(LevelLaw::linear, r, levels, specular.size());
      look_up_cube(specular, reflected, level, a);
      look_up_cube(set.specular, reflected, level, b);
      (i == 0 ? mirror : glossy).add(a, b, pixels * (dfg.scale + dfg.bias));
    }
  }
  return {mirror.relative(), glossy.relative(), matt.relative()};
}

// The measure of edge_step_ratio on the borders of 4 x 4 blocks inside the faces, along x: what any border shows.
double block_step_ratio(const Cube& cube) {
  double step = 0, predicted = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < cube.size; ++y)
      for (int x = 4; x + 4 <= cube.size; x += 4)
        for (int c = 0; c < 3; ++c) {
          const auto rise = [&](int at) {
            return static_cast<double>(cube.at(face, at, y)[c]) -
                   static_cast<double>(cube.at(face, at - 1, y)[c]);
          };
          step += std::abs(rise(x));
          predicted += std::abs(4 * (rise(x - 1) + rise(x + 1)) - rise(x - 2) - rise(x + 2)) / 6;
        }
  return predicted > 0 ? step / predicted : 0;
}

double largest_block_step(const CubeMips& cube) {
  double largest = 0;
  for (std::size_t k = 1; k < cube.levels.size(); ++k)
    largest = std::max(largest, block_step_ratio(cube.levels[k]));
  return largest;
}

double largest_edge_step(const std::vector<StoredErrors>& errors) {
  double largest = 0;
  for (std::size_t k = 1; k < errors.size(); ++k) largest = std::max(largest, errors[k].edge_step);
  return largest;
}

std::string row(const Storage& storage, const IblSet& set) {
  std::vector<std::uint8_t> bytes;
  const double seconds = bench::seconds_of([&] { bytes = encode(set.specular, storage).bytes; });
  const CubeMips specular = decode_ktx2(bytes, storage.name).cube;
  const Cube irradiance = through(CubeMips{{set.irradiance}}, storage).levels.front();
  const SphereErrors sphere = light_sphere(set, specular, irradiance);
  const auto stored = stored_errors(specular, set.specular, EdgeFixup::none);
  return fmt::format("{:<15} {:>9} {:>9.1f}   {:.1e}  {:.1e}  {:.1e}  {:.1e}   {:.3f} {:.3f}", storage.name,
                     bytes.size(), 1000 * seconds, stored[0].relative_rms, sphere.mirror, sphere.glossy,
                     sphere.matt, largest_edge_step(stored), largest_block_step(specular));
}

// RMS difference of the clamped look-up in a fixed cube from the seamless one in the plain cube.
double lookup_difference(const Cube& plain, const Cube& fixed, EdgeFixup fixup) {
  ErrorSum sum;
  float a[3], b[3];
  for (const Vec3 d : sphere_points(20000, 9)) {
    look_up_cube_face(fixed, d, fixup, a);
    look_up_cube(plain, d, b);
    sum.add(a, b, 1);
  }
  return sum.relative();
}

void print_compressed_seams(bench::Report& report, const IblSet& set, const Storage& storage) {
  for (const EdgeFixup fixup : {EdgeFixup::none, EdgeFixup::warp, EdgeFixup::average}) {
    const CubeMips fixed = fix_edges(set.specular, fixup);
    std::string line = fmt::format("{:<12} {:<8}", storage.name, edge_fixup_name(fixup));
    for (const StoredErrors& e :
         stored_errors(through(fixed, storage, fixup != EdgeFixup::none), fixed, fixup))
      line += fmt::format("  {:.1e} ({:.3f})", e.face_step, e.edge_step);
    report.note(line);
  }
}

void print_seams(bench::Report& report, const IblSet& set) {
  report.note(
      "seams, look-ups clamped to faces: step across edges over the value there; in brackets: off the "
      "seamless look-up");
  report.note("level size      none                warp                average");
  for (std::size_t k = 0; k + 1 < set.specular.levels.size(); ++k) {
    const Cube& level = set.specular.levels[k];
    std::string line = fmt::format("{:>5} {:>4}", k, level.size);
    for (const EdgeFixup fixup : {EdgeFixup::none, EdgeFixup::warp, EdgeFixup::average}) {
      const Cube fixed = fix_edges(level, fixup);
      line += fmt::format("   {:.1e} ({:.1e})", face_edge_step(fixed, fixup),
                          lookup_difference(level, fixed, fixup));
    }
    report.note(line);
  }
  report.note(
      "the same after compression, of levels 0, 1, ...; and edge_step, seamless, of levels that are wide "
      "enough");
  for (const Storage& storage : {storages()[4], storages()[7]}) print_compressed_seams(report, set, storage);
}

void bench_map(bench::Report& report, const std::string& input) {
  IblOptions options;
  options.size = 128;
  const IblSet set = make_ibl(load_environment(input).radiance, options);
  report.note(fmt::format("-- {}: specular of {}, {} levels; relative RMS errors", input, options.size,
                          set.specular.levels.size()));
  report.note("format              bytes encode ms   texels   mirror   glossy   matt      edge  block step");
  for (const Storage& storage : storages()) report.note(row(storage, set));
  print_seams(report, set);
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  std::vector<std::string> inputs(argv + 1, argv + argc);
  if (inputs.empty()) inputs = {"sky:day", "sky:studio", "sky:day,elevation=-8,sun=0"};
  for (const std::string& input : inputs) bench_map(report, input);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_compression: {}\n", error.what());
  return 1;
}
