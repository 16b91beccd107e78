#include <algorithm>

#include "measure.h"

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/sphere/resample.h>

// Resampling between layouts of the sphere. The error is what the filter itself does to the energy, before
// keep_energy puts it back; the yardstick is a copy of the same texels.

namespace {

using namespace welkin;

double copy_rate(const Image& image) {  // texels/s
  std::vector<float> copy(image.pixels.size());
  const bench::Timing time =
      bench::measure(5, [&] { std::copy(image.pixels.begin(), image.pixels.end(), copy.begin()); });
  return static_cast<double>(image.pixels.size()) / 3 / time.best;
}

// A constant must come through as it is, to float rounding.
double constant_error(MapShape from, MapShape to) {
  SphereMap flat = make_sphere_map({from.mapping, from.width / 4, from.height / 4});
  std::fill(flat.image.pixels.begin(), flat.image.pixels.end(), 2.5f);
  const MapShape small{to.mapping, to.width / 4, to.height / 4};
  const SphereMap out = resample(flat, small, {false, true, {}});
  double largest = 0;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      if (map_texel_solid_angle(small, x, y) > 0)
        largest = std::max(largest, std::abs(out.image.at(x, y)[0] / 2.5 - 1));
  return largest;
}

void bench_pair(bench::Report& report, const SphereMap& source, MapShape target, double copy) {
  const MapShape from = source.shape();
  report.note(fmt::format("{} {}x{} to {} {}x{}", mapping_name(from.mapping), from.width, from.height,
                          mapping_name(target.mapping), target.width, target.height));
  report.check("  a constant stays one", constant_error(from, target), 1e-6);
  ResampleReport done;
  const bench::Timing time = bench::measure(2, [&] { resample(source, target, {}, &done); });
  double energy = 0;
  for (double ratio : done.raw_energy_ratio) energy = std::max(energy, std::abs(ratio - 1));
  const double texels = std::max(1.0 * from.width * from.height, 1.0 * target.width * target.height);
  report.figure("  time, raw energy", time, energy, 1e-3,
                fmt::format("{:.1f} Mtexel/s of the larger map; copy {:.0f} Mtexel/s",
                            texels / time.best / 1e6, copy / 1e6));
}

}  // namespace

int main() try {
  bench::Report report;
  const SphereMap sky{Mapping::equirectangular, make_sky(parse_sky("sky:day,size=1024x512"))};
  const SphereMap large{Mapping::equirectangular, make_sky(parse_sky("sky:day,size=4096x2048"))};
  const double copy = copy_rate(large.image);
  bench_pair(report, large, map_shape(Mapping::cube, 256), copy);
  bench_pair(report, sky, map_shape(Mapping::cube, 256), copy);
  bench_pair(report, sky, map_shape(Mapping::cube, 512), copy);
  bench_pair(report, large, {Mapping::equirectangular, 1024, 512}, copy);
  bench_pair(report, resample(sky, map_shape(Mapping::cube, 256)), map_shape(Mapping::equirectangular, 512),
             copy);
  for (Mapping mapping : {Mapping::dual_paraboloid, Mapping::mirror_ball, Mapping::octahedral}) {
    bench_pair(report, sky, map_shape(mapping, 512), copy);
    bench_pair(report, resample(sky, map_shape(mapping, 512)), map_shape(Mapping::cube, 256), copy);
  }
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_resample: {}\n", error.what());
  return 1;
}
