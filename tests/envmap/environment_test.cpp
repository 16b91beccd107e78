#include <welkin/envmap/environment.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "maps.h"

#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/sphere/cube_layout.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/labelled_map.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

class EnvironmentFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("welkin_environment_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string save(const std::string& name, const Image& image) {
    const auto path = folder_ / name;
    save_image(path, image);
    return path.string();
  }
  std::filesystem::path folder_;
};

std::string error_of(const std::string& input, const EnvironmentOptions& options = {}) {
  try {
    load_environment(input, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(EnvironmentFiles, SkiesNeedNoFile) {
  const Environment e = load_environment("sky:constant,value=2,size=64x32");
  EXPECT_EQ(e.radiance.width, 64);
  for (float v : e.radiance.pixels) ASSERT_EQ(v, 2);
}

TEST_F(EnvironmentFiles, APictureInMemoryIsTheSameAsItsFile) {
  Image image(8, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  const std::string path = save("ramp.exr", image);
  const EnvironmentOptions turned{{}, 90};
  const Environment from_memory = make_environment(load_image(path), "ramp", turned);
  EXPECT_EQ(from_memory.radiance.pixels, load_environment(path, turned).radiance.pixels);
  EXPECT_EQ(from_memory.source, "ramp");
  LoadedImage square;
  square.flat = Image(4, 4);
  try {
    make_environment(square, "square");
    FAIL() << "its proportions fit no mapping";
  } catch (const Error& error) {
    EXPECT_EQ(error.path(), "square");
  }
}

TEST_F(EnvironmentFiles, ACubeCrossBecomesTheSamePanorama) {
  const SphereMap cube = labelled_map(map_shape(Mapping::cube, 64));
  const std::string path =
      save("cross.exr", cube_to_layout(cube_from_sphere_map(cube), CubeLayout::horizontal_cross));
  const Environment e = load_environment(path);
  EXPECT_EQ(e.radiance.width, 2 * e.radiance.height);
  // The middle of every face's label background is far from any letter's edge only by luck, so compare with the map
  // drawn directly, on average: letters' borders are a few per cent of the texels.
  const Image direct = labelled_map({Mapping::equirectangular, e.radiance.width, e.radiance.height}).image;
  double wrong = 0;
  for (std::size_t i = 0; i < direct.pixels.size(); ++i)
    wrong += std::abs(direct.pixels[i] - e.radiance.pixels[i]) > 0.2f;
  EXPECT_LT(wrong / static_cast<double>(direct.pixels.size()), 0.06);
}

TEST_F(EnvironmentFiles, RepairsFaultsAndSaysSo) {
  Image map = constant_map(16, 8, 1);
  map.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  map.pixels[8] = std::numeric_limits<float>::infinity();
  map.pixels[11] = -3;
  const std::string path = save("faults.exr", map);
  const Environment e = load_environment(path);
  EXPECT_EQ(e.faults.nan, 1u);
  EXPECT_EQ(e.faults.negative, 1u);
  ASSERT_FALSE(e.warnings.empty());
  for (float v : e.radiance.pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0);
  EnvironmentOptions refuse;
  refuse.faults = FaultPolicy::refuse;
  EXPECT_NE(error_of(path, refuse).find("faults.exr"), std::string::npos);
}

TEST_F(EnvironmentFiles, NamesWhatIsWrong) {
  EXPECT_NE(error_of((folder_ / "none.hdr").string()).find("none.hdr"), std::string::npos);
  EXPECT_NE(error_of(save("odd.hdr", constant_map(50, 20, 1))).find("50 x 20"), std::string::npos);
  EXPECT_NE(error_of(save("black.hdr", constant_map(16, 8, 0))).find("black"), std::string::npos);
  EXPECT_NE(error_of("sky:nonsense").find("nonsense"), std::string::npos);
  EnvironmentOptions ball;
  ball.mapping = Mapping::mirror_ball;
  EXPECT_NE(error_of(save("wide.hdr", constant_map(16, 8, 1)), ball).find("wide.hdr"), std::string::npos);
}

// The sky's own values are refused by its parser; a file's by the largest of them.
TEST_F(EnvironmentFiles, ValuesWhoseIrradianceLeavesFloatAreRefused) {
  Image map = constant_map(16, 8, 1);
  map.pixels[10] = 2e30f;
  const std::string message = error_of(save("bright.hdr", map));
  EXPECT_NE(message.find("bright.hdr: holds values up to"), std::string::npos) << message;
}

TEST_F(EnvironmentFiles, EveryErrorNamesTheInput) {
  const std::string path = save("fine.hdr", constant_map(16, 8, 1));
  EnvironmentOptions turned;
  for (const double degrees : {std::nan(""), HUGE_VAL}) {
    turned.rotate_degrees = degrees;
    EXPECT_TRUE(error_of(path, turned).starts_with(path + ": ")) << error_of(path, turned);
  }
  for (const std::string sky : {"sky:nonsense", "sky:day,size=4", "sky:day,elevation=100"})
    EXPECT_TRUE(error_of(sky).starts_with(sky + ": ")) << error_of(sky);
}

// What is at +X comes to -Z when the environment is turned by 90 degrees about +Y (right-handed).
TEST_F(EnvironmentFiles, RotatesAboutTheVertical) {
  Image map = constant_map(64, 32, 0);
  map.at(32, 15)[0] = 1;  // towards +X
  const std::string path = save("point.hdr", map);
  EnvironmentOptions options;
  options.rotate_degrees = 90;
  const Image turned = load_environment(path, options).radiance;
  const Uv uv = equirect_uv(Vec3{0, 0.05, -1});
  EXPECT_EQ(turned.at(static_cast<int>(uv.u * 64), 15)[0], 1);
}

}  // namespace
}  // namespace welkin
