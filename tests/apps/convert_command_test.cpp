#include <algorithm>
#include <cmath>

#include "command_test.h"

#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/load.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/labelled_map.h>

// welkin convert: from every mapping, layout and container to every other and back.

namespace welkin {
namespace {

class ConvertTest : public CommandTest {
 protected:
  void make_sky_file(const std::string& kind, const std::string& size, const std::string& name) const {
    run_well({"sky", "--kind", kind, "--size", size, "-o", name});
  }
  nlohmann::json difference(const std::string& a, const std::string& b) const {
    return nlohmann::json::parse(run_well({"compare", a, b, "--json"}))["parts"][0];
  }
};

// The label whose colour is nearest to a pixel.
Label nearest_label(const float* pixel) {
  Label best;
  double least = 1e9;
  for (int face = 0; face < 6; ++face)
    for (const bool ink : {false, true}) {
      const auto colour = label_radiance({face, ink});
      double distance = 0;
      for (std::size_t c = 0; c < 3; ++c) distance += std::pow(pixel[c] - colour[c], 2);
      if (distance < least) least = distance, best = {face, ink};
    }
  return best;
}

// All letters are white, whichever face they are on.
bool same_colour(Label a, Label b) { return a.ink && b.ink ? true : a == b; }

// Labels of the map's texels that differ from the truth, among those whose neighbours all have the same label: what
// resampling blends at the borders of labels is a matter of its kernel.
struct LabelCount {
  int inside = 0, wrong = 0;
};

LabelCount count_labels(const Image& map) {
  const auto truth = [&](int x, int y) {
    return label_at(map_texel_direction({Mapping::equirectangular, map.width, map.height}, x, y));
  };
  LabelCount count;
  for (int y = 1; y + 1 < map.height; ++y)
    for (int x = 1; x + 1 < map.width; ++x) {
      const Label label = truth(x, y);
      bool inside = true;
      for (int k = 0; k < 9; ++k) inside = inside && truth(x + k % 3 - 1, y + k / 3 - 1) == label;
      count.inside += inside ? 1 : 0;
      count.wrong += inside && !same_colour(nearest_label(map.at(x, y)), label) ? 1 : 0;
    }
  return count;
}

class ConvertMappingTest : public ConvertTest, public testing::WithParamInterface<const char*> {};

TEST_P(ConvertMappingTest, LabelsComeBackInTheirPlaces) {
  const std::string mapping = GetParam();
  make_sky_file("labelled", "192x96", "labelled.exr");
  const LabelCount before = count_labels(load_image(at("labelled.exr")).flat);
  EXPECT_EQ(before.wrong, 0);
  EXPECT_GT(before.inside, 192 * 96 / 2);
  // Finer in between: a mirror ball squeezes what is around -Z into thin rings at its rim.
  run_well({"convert", "labelled.exr", "--to", mapping, "--size", "512", "-o", "there.exr"});
  run_well({"convert", "there.exr", "--from", mapping, "--to", "equirectangular", "--size", "192x96", "-o",
            "back.exr"});
  EXPECT_EQ(count_labels(load_image(at("back.exr")).flat).wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(All, ConvertMappingTest,
                         testing::Values("equirectangular", "cube", "dual-paraboloid", "mirror-ball",
                                         "octahedral"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Every way to keep a cube moves its texels bit for bit; the values are halves from the first file on.
TEST_F(ConvertTest, CubeLayoutsAndContainersAreExact) {
  make_sky_file("studio", "64x32", "sky.exr");
  run_well({"convert", "sky.exr", "--to", "cube", "--size", "16", "-o", "cube.ktx2"});
  const std::vector<std::vector<std::string>> ways{{"hcross.exr", "--layout", "hcross"},
                                                   {"vcross.exr", "--layout", "vcross"},
                                                   {"hstrip.exr", "--layout", "hstrip"},
                                                   {"vstrip.exr", "--layout", "vstrip"},
                                                   {"default.exr"},
                                                   {"six_%s.exr"},
                                                   {"other.dds", "--format", "rgba32f"},
                                                   {"strip.ktx2", "--layout", "hstrip"},
                                                   {"faces.exr", "--layout", "six"}};
  for (const auto& way : ways) {
    std::vector<std::string> there{"convert", "cube.ktx2", "-o"};
    there.insert(there.end(), way.begin(), way.end());
    run_well(there);
    const std::string name = way[0] == "faces.exr" ? "faces_%s.exr" : way[0];
    run_well({"convert", name, "-o", "back.ktx2"});
    EXPECT_EQ(difference("back.ktx2", "cube.ktx2")["max_abs"], 0) << way[0];
  }
}

TEST_F(ConvertTest, SixFilesByAllTheirNames) {
  make_sky_file("labelled", "64x32", "sky.exr");
  run_well({"convert", "sky.exr", "--to", "cube", "--size", "8", "-o", "cube.ktx2"});
  run_well({"convert", "cube.ktx2", "-o", "a_%s.exr"});
  const std::string names[3][6] = {{"px", "nx", "py", "ny", "pz", "nz"},
                                   {"posx", "negx", "posy", "negy", "posz", "negz"},
                                   {"0", "1", "2", "3", "4", "5"}};
  for (int style = 1; style < 3; ++style) {
    const std::string pattern = style == 1 ? "b_%s.exr" : "c_%s.exr";
    for (int face = 0; face < 6; ++face)
      std::filesystem::copy_file(at("a_" + names[0][face] + ".exr"),
                                 at(pattern.substr(0, 2) + names[style][face] + ".exr"));
    run_well({"convert", pattern, "-o", "back.ktx2"});
    EXPECT_EQ(difference("back.ktx2", "cube.ktx2")["max_abs"], 0) << pattern;
  }
}

TEST_F(ConvertTest, ASmoothMapComesBackThroughACube) {
  make_sky_file("ramp", "64x32", "ramp.exr");
  run_well({"convert", "ramp.exr", "--to", "cube", "--size", "64", "--format", "rgba32f", "-o", "cube.ktx2"});
  run_well({"convert", "cube.ktx2", "--to", "equirectangular", "--size", "32", "-o", "back.exr"});
  // Radiance runs from 0.5 to 1.5 over 32 rows: 0.05 a row at most, and what is left is a small part of one.
  EXPECT_LT(difference("back.exr", "ramp.exr")["max_abs"], 0.01);
  EXPECT_LT(difference("back.exr", "ramp.exr")["relative_rmse"], 0.002);
}

TEST_F(ConvertTest, EnergyIsKept) {
  make_sky_file("day", "128x64", "day.exr");
  const auto energy = [&](const Arguments& more) {
    Arguments arguments{"info", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nlohmann::json::parse(run_well(arguments))["energy"][1].get<double>();
  };
  const double truth = energy({"day.exr"});
  for (const std::string mapping : {"cube", "dual-paraboloid", "mirror-ball", "octahedral"}) {
    run_well({"convert", "day.exr", "--to", mapping, "-o", mapping + ".exr"});
    EXPECT_NEAR(energy({mapping + ".exr", "--mapping", mapping}), truth, 1e-3 * truth)
        << mapping;  // half floats
  }
}

TEST_F(ConvertTest, TurnsAndMirrors) {
  make_sky_file("labelled", "64x32", "a.exr");
  const Image a = load_image(at("a.exr")).flat;
  run_well({"convert", "a.exr", "--rotate", "90", "-o", "turned.exr"});
  run_well({"convert", "a.exr", "--mirror", "-o", "mirrored.exr"});
  const Image turned = load_image(at("turned.exr")).flat, mirror = load_image(at("mirrored.exr")).flat;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      ASSERT_EQ(turned.at(x, y)[0], a.at((x + 16) % 64, y)[0]);  // to the left by a quarter
      ASSERT_EQ(mirror.at(x, y)[0], a.at(63 - x, y)[0]);
    }
  run_well({"convert", "turned.exr", "--rotate", "-90", "-o", "back.exr"});
  EXPECT_EQ(difference("back.exr", "a.exr")["max_abs"], 0);
}

TEST_F(ConvertTest, FlatMapsInEveryFile) {
  make_sky_file("studio", "32x16", "a.exr");
  // Bounds are the formats': half floats twice rounded, 9 bits, 8 bits of the largest channel; all over the RMS.
  const std::pair<std::string, double> files[] = {
      {"b.ktx2", 1e-9}, {"b.dds", 1e-9}, {"b.hdr", 4e-3}, {"b.pic", 4e-3}};
  for (const auto& [name, bound] : files) {
    run_well({"convert", "a.exr", "-o", name});
    EXPECT_LE(difference(name, "a.exr")["relative_rmse"], bound) << name;
  }
  run_well({"convert", "a.exr", "--format", "rgb9e5", "-o", "b.ktx2"});
  EXPECT_LE(difference("b.ktx2", "a.exr")["relative_rmse"], 2e-3);
  run_well({"convert", "a.exr", "-o", "b.png"});
  EXPECT_EQ(read_text(at("b.png")).substr(1, 3), "PNG");
}

TEST_F(ConvertTest, Levels) {
  make_sky_file("studio", "64x32", "a.exr");
  run_well({"convert", "a.exr", "--to", "cube", "--size", "16", "--mips", "-o", "cube.ktx2"});
  const CubeMips cube = load_image(at("cube.ktx2")).cube;
  ASSERT_EQ(cube.levels.size(), 5u);
  EXPECT_EQ(cube.levels.back().size, 1);
}

TEST_F(ConvertTest, ABrightSunIsScaledAndSaid) {
  run_well({"sky", "--kind", "texel", "--value", "196608", "--size", "32x16", "-o", "sun.exr"});
  // 196,608 / 4 is a half float.
  const RunResult ktx2 = run({"convert", "sun.exr", "-o", "sun.ktx2"});
  EXPECT_EQ(ktx2.exit_code, 0);
  EXPECT_EQ(ktx2.err,
            "welkin: sun.ktx2: warning: values are stored divided by 4; the key WelkinStoredScale says so\n");
  EXPECT_EQ(difference("sun.ktx2", "sun.exr")["max_abs"], 0);
  EXPECT_EQ(read_ktx2_keys(read_file(at("sun.ktx2")), "sun").count("WelkinStoredScale"), 1u);
  const RunResult dds = run({"convert", "sun.exr", "-o", "sun.dds"});
  EXPECT_EQ(dds.err, "welkin: sun.dds: warning: values are stored divided by 4, which DDS cannot say\n");
  run_well({"convert", "sun.exr", "--format", "rgba32f", "-o", "full.dds"});
  EXPECT_EQ(difference("full.dds", "sun.exr")["max_abs"], 0);
}

}  // namespace
}  // namespace welkin
