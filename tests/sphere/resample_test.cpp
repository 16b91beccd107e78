#include <welkin/sphere/resample.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/labelled_map.h>

namespace welkin {
namespace {

bool valid(MapShape shape, int x, int y) { return map_texel_solid_angle(shape, x, y) > 0; }

SphereMap filled(MapShape shape, float value) {
  SphereMap map = make_sphere_map(shape);
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x)
      std::fill_n(map.image.at(x, y), 3, valid(shape, x, y) ? value : 0.0f);
  }
  return map;
}

SphereMap noise(MapShape shape, unsigned seed) {
  SphereMap map = make_sphere_map(shape);
  std::mt19937 random(seed);
  for (float& value : map.image.pixels) value = static_cast<float>(random() % 1000) / 500;
  return map;
}

// Calls check(source shape, target shape) for all 25 pairs.
template <class Check>
void for_each_pair(int source_size, int target_size, Check&& check) {
  for (Mapping from : all_mappings) {
    for (Mapping to : all_mappings) check(map_shape(from, source_size), map_shape(to, target_size));
  }
}

std::string pair_name(MapShape from, MapShape to) {
  return std::string(mapping_name(from.mapping)) + " " + std::to_string(from.height) + " -> " +
         std::string(mapping_name(to.mapping)) + " " + std::to_string(to.height);
}

double worst_energy_error(const SphereMap& source, MapShape target) {
  const auto before = map_energy(source), after = map_energy(resample(source, target));
  double worst = 0;
  for (std::size_t c = 0; c < before.size(); ++c) worst = std::max(worst, std::abs(after[c] / before[c] - 1));
  return worst;
}

// 1e-6: texels are floats.
TEST(Resample, AConstantStaysConstant) {
  for (auto [source_size, target_size] : {std::pair{24, 24}, std::pair{32, 9}, std::pair{8, 40}}) {
    for_each_pair(source_size, target_size, [](MapShape from, MapShape to) {
      const SphereMap result = resample(filled(from, 3), to);
      for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
          const float expected = valid(to, x, y) ? 3.0f : 0.0f;
          ASSERT_NEAR(result.image.at(x, y)[2], expected, 3e-6)
              << pair_name(from, to) << " " << x << " " << y;
        }
      }
    });
  }
}

// 1e-4 is the promise; what remains is the rounding of texels to float.
TEST(Resample, EnergyIsKeptForOneTexelSunsAndNoise) {
  for (auto [source_size, target_size] : {std::pair{48, 12}, std::pair{12, 48}, std::pair{20, 21}}) {
    for_each_pair(source_size, target_size, [](MapShape from, MapShape to) {
      std::mt19937 random(17);
      EXPECT_LT(worst_energy_error(noise(from, 2), to), 1e-4) << pair_name(from, to);
      for (int k = 0; k < 2; ++k) {
        int x = 0, y = 0;
        do {
          x = static_cast<int>(random() % static_cast<unsigned>(from.width));
          y = static_cast<int>(random() % static_cast<unsigned>(from.height));
        } while (!valid(from, x, y));
        SphereMap one = filled(from, 0), sun = noise(from, 3);
        for (int c = 0; c < 3; ++c) one.image.at(x, y)[c] = 1, sun.image.at(x, y)[c] = 1e5f;
        EXPECT_LT(worst_energy_error(one, to), 1e-4) << pair_name(from, to) << " at " << x << " " << y;
        EXPECT_LT(worst_energy_error(sun, to), 1e-4) << pair_name(from, to) << " at " << x << " " << y;
      }
    });
  }
}

// Without putting energy back: what overlap and interpolation do by themselves. At real sizes noise is right to
// 1e-5 and a sun of 4 x 4 texels to 1e-3 (measured 4e-4: the quadrilaterals' straight edges).
TEST(Resample, OverlapAloneNearlyKeepsEnergy) {
  const MapShape panorama{Mapping::equirectangular, 1024, 512}, cube = map_shape(Mapping::cube, 128);
  ResampleReport report;
  resample(noise(panorama, 4), cube, {}, &report);
  for (double ratio : report.raw_energy_ratio) EXPECT_NEAR(ratio, 1, 1e-5);
  SphereMap sun = make_sphere_map(panorama, 1);
  for (int y = 130; y < 134; ++y) std::fill_n(sun.image.at(700, y), 4, 1e5f);
  report = {};
  resample(sun, cube, {}, &report);
  EXPECT_NEAR(report.raw_energy_ratio[0], 1, 1e-3);
}

// Brute force: the mean over each target texel's patch of the nearest source texel, by many points. With n^2 points
// a texel of the source (about (n/5)^2 of them) is measured to a few parts in n, and noise averages that down.
TEST(Resample, MinificationIsTheMeanOverThePatch) {
  constexpr int n = 200;
  const MapShape from{Mapping::equirectangular, 80, 40}, to = map_shape(Mapping::cube, 6);
  const SphereMap source = noise(from, 9), result = resample(source, to, {false, true, {}});
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      double sum = 0, weight = 0;
      for (int k = 0; k < n * n; ++k) {
        const Vec3 d = map_texel_direction(to, x, y, (k % n + 0.5) / n, (k / n + 0.5) / n);
        const MapPoint p = map_point(from, d);
        const double w = map_density(to, d);
        sum += w * source.image.at(static_cast<int>(p.x), static_cast<int>(p.y))[0];
        weight += w;
      }
      ASSERT_NEAR(result.image.at(x, y)[0], sum / weight, 0.01) << x << " " << y;
    }
  }
}

// The colour of the labelled map that is nearest to a texel's: one of six faces or the letters' white.
std::array<float, 3> nearest_label(const float* texel) {
  std::array<float, 3> best{};
  double least = 1e9;
  for (int k = 0; k < 12; ++k) {
    const auto radiance = label_radiance({k / 2, k % 2 == 1});
    double distance = 0;
    for (std::size_t c = 0; c < 3; ++c) distance += std::abs(radiance[c] - texel[c]);
    if (distance < least) least = distance, best = radiance;
  }
  return best;
}

// Whether all directions within `radius` (checked on rings) carry one label.
bool far_from_border(Vec3 d, double radius) {
  const Label label = label_at(d);
  const Vec3 a = normalized(cross(d, std::abs(d.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0})), b = cross(d, a);
  for (double r : {0.34 * radius, 0.67 * radius, radius}) {
    for (int k = 0; k < 16; ++k) {
      const double angle = k * std::numbers::pi / 8;
      if (!(label_at(d + r * (std::cos(angle) * a + std::sin(angle) * b)) == label)) return false;
    }
  }
  return true;
}

// How far a border may be smeared, in radians: by half a texel of both maps and by the kernel of 1.7 texels, where the
// widest texels of a map of size 96 are 2 / 96 (cube) to 3 * 2 / 96 (octahedral). Those of a mirror ball become
// wider without limit towards -Z.
double smear(bool ball, Vec3 d) { return ball ? 0.09 / std::sqrt((1 + d.z) / 2 + 1 / 96.0) : 0.07; }

// The texels that are farther than that from every border, remembered because every pair asks.
const std::vector<bool>& clear_texels(MapShape shape, bool ball) {
  static std::map<std::pair<Mapping, bool>, std::vector<bool>> known;
  std::vector<bool>& clear = known[{shape.mapping, ball}];
  if (!clear.empty()) return clear;
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      const Vec3 d = map_texel_direction(shape, x, y);
      clear.push_back(map_covers(shape, x, y) && far_from_border(d, smear(ball, d)));
    }
  }
  return clear;
}

// Every texel that is farther from a border of labels than the smear shows its own label. Returns how many there were.
int check_labels(const SphereMap& map, bool ball, const std::string& name) {
  const MapShape shape = map.shape();
  const std::vector<bool>& clear = clear_texels(shape, ball);
  int checked = 0, wrong = 0;
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      const Vec3 d = map_texel_direction(shape, x, y);
      if (!clear[static_cast<std::size_t>(y) * shape.width + x]) continue;
      const Label label = label_at(d);
      wrong += nearest_label(map.image.at(x, y)) != label_radiance(label) ? 1 : 0;
      ++checked;
    }
  }
  EXPECT_EQ(wrong, 0) << name;
  return checked;
}

// Each pair, there and back.
TEST(Resample, TheLabelledMapGoesThroughEveryPairAndBack) {
  for_each_pair(96, 96, [](MapShape from, MapShape to) {
    const bool ball = from.mapping == Mapping::mirror_ball || to.mapping == Mapping::mirror_ball;
    const int enough = ball ? 400 : 4000;
    const SphereMap there = resample(labelled_map(from), to);
    EXPECT_GT(check_labels(there, ball, pair_name(from, to)), enough);
    EXPECT_GT(check_labels(resample(there, from), ball, pair_name(from, to) + " and back"), enough);
  });
}

// Second differences along rows and columns of the middle of a picture, largest magnitude.
double sharpest_bend(const Image& image, int x0, int x1, int y0, int y1) {
  double worst = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const float here = image.at(x, y)[0];
      worst = std::max(worst, std::abs(double{image.at(x - 1, y)[0]} + image.at(x + 1, y)[0] - 2 * here));
      worst = std::max(worst, std::abs(double{image.at(x, y - 1)[0]} + image.at(x, y + 1)[0] - 2 * here));
    }
  }
  return worst;
}

// Bilinear interpolation bends at texel centres: by the difference of slopes, for noise in [0, 2] at 8x about 2 * 2/8
// at worst (measured on the same noise). A C1 curve spreads that over a texel: by 1/8 of it times its curvature.
TEST(Resample, MagnificationIsSmooth) {
  const MapShape coarse{Mapping::equirectangular, 32, 16}, fine{Mapping::equirectangular, 256, 128};
  const SphereMap source = noise(coarse, 11);
  const Image smooth = resample(source, fine).image;
  Image bilinear(256, 128, 3);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      const double sx = (x + 0.5) / 8 - 0.5, sy = (y + 0.5) / 8 - 0.5;
      const int x0 = static_cast<int>(std::floor(sx)),
                y0 = std::clamp(static_cast<int>(std::floor(sy)), 0, 14);
      const auto at = [&](int i, int j) { return double{source.image.at((i + 32) % 32, j)[0]}; };
      const double fx = sx - x0, fy = std::clamp(sy - y0, 0.0, 1.0);
      bilinear.at(x, y)[0] = static_cast<float>((1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
                                                fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1)));
    }
  }
  EXPECT_LT(sharpest_bend(smooth, 1, 255, 40, 88), 0.5 * sharpest_bend(bilinear, 1, 255, 40, 88));
}

// Steps between neighbouring texels across cube edges, relative to those inside faces.
TEST(Resample, CubeEdgesDoNotShowWhenMagnified) {
  const SphereMap source = noise(map_shape(Mapping::cube, 8), 12);
  const Image fine = resample(source, {Mapping::equirectangular, 512, 256}).image;
  double across = 0, inside = 0;
  for (int y = 100; y < 156; ++y) {
    for (int x = 0; x + 1 < 512; ++x) {
      const double step = std::abs(fine.at(x + 1, y)[0] - fine.at(x, y)[0]);
      const bool edge = (x + 1) % 128 == 64;  // longitudes of 45 degrees
      (edge ? across : inside) = std::max(edge ? across : inside, step);
    }
  }
  EXPECT_GT(across, 0);
  EXPECT_LE(across, 1.05 * inside);
}

TEST(Resample, NeverLeavesTheRangeOfTheSource) {
  for_each_pair(8, 40, [](MapShape from, MapShape to) {
    SphereMap source = noise(from, 6);
    const SphereMap result = resample(source, to, {false, true, {}});
    for (float value : result.image.pixels) {
      ASSERT_GE(value, 0) << pair_name(from, to);
      ASSERT_LE(value, 1.999f) << pair_name(from, to);
    }
  });
}

TEST(Resample, EqualShapesAreCopied) {
  const SphereMap source = noise(map_shape(Mapping::octahedral, 17), 8);
  EXPECT_EQ(resample(source, source.shape()).image.pixels, source.image.pixels);
}

TEST(Resample, TheSameBytesOnAnyNumberOfThreads) {
  const SphereMap source = noise({Mapping::equirectangular, 64, 32}, 21);
  set_thread_count(1);
  const Cube expected = equirect_to_cube(source.image, 48);
  for (int threads : {2, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(equirect_to_cube(source.image, 48).texels, expected.texels);
  }
  set_thread_count(0);
}

TEST(Resample, CubeFunctionsAgreeWithTheGeneralOne) {
  const SphereMap panorama = noise({Mapping::equirectangular, 48, 24}, 22);
  const Cube cube = equirect_to_cube(panorama.image, 16);
  EXPECT_EQ(cube.texels, resample(panorama, map_shape(Mapping::cube, 16)).image.pixels);
  EXPECT_EQ(cube_to_equirect(cube, 40, 20).pixels,
            resample(sphere_map_from_cube(cube), {Mapping::equirectangular, 40, 20}).image.pixels);
}

TEST(Resample, RefusesWhatItCannotDo) {
  EXPECT_THROW(resample(SphereMap{}, map_shape(Mapping::cube, 4)), Error);
  EXPECT_THROW(equirect_to_cube(Image(4, 2, 5), 4), Error);
  EXPECT_THROW(equirect_to_cube(Image(4, 2), 0), Error);
  for (const double x : {2.0, 0.0, std::nan(""), HUGE_VAL}) {
    ResampleOptions options;
    options.orientation.rows[0].x = x;
    EXPECT_THROW(equirect_to_cube(Image(4, 2), 4, options), Error) << x;
    EXPECT_THROW(cube_to_equirect(Cube(4), 8, 4, options), Error) << x;
    EXPECT_THROW(resample({Mapping::equirectangular, Image(4, 2)}, map_shape(Mapping::cube, 4), options),
                 Error)
        << x;
  }
}

}  // namespace
}  // namespace welkin
