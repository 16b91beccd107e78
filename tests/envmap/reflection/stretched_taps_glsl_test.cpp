#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

#include <welkin/envmap/reflection/stretched_taps.h>

namespace welkin {
namespace {

TEST(StretchedTapsShader, Compiles) {
  if (std::string(WELKIN_GLSLANG).empty())
    GTEST_SKIP() << "glslangValidator (Debian glslang-tools) is not there";
  StretchedTapsTable table;
  table.taps = 3;
  table.roughness_size = 24;
  const auto folder = std::filesystem::temp_directory_path() / ("welkin-taps-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* version : {"#version 300 es\nprecision highp float;\n", "#version 330\n"}) {
    std::ofstream(folder / "taps.frag")
        << version << "float level_of(float r) { return 6.0 * r; }\n"
        << stretched_taps_glsl(table)
        << "in vec3 n, v;\nout vec4 color;\n"
           "void main() { color = vec4(stretched_reflection(n, v, vec3(0.04), 0.5), 1.0); }\n";
    const std::string command = "cd '" + folder.string() + "' && " WELKIN_GLSLANG " taps.frag > log.txt 2>&1";
    const int code = std::system(command.c_str());
    std::stringstream log;
    log << std::ifstream(folder / "log.txt").rdbuf();
    EXPECT_EQ(code, 0) << log.str();
  }
  std::filesystem::remove_all(folder);
}

// The texture read as the shader reads it, texel by texel.
TEST(StretchedTapsImage, HoldsEveryTap) {
  const StretchedTapsTable table = make_stretched_taps_table({16, 3, LevelLaw::linear}, {2, 5, 4, 2});
  const Image image = stretched_taps_image(table);
  ASSERT_EQ(image.width, 5);
  ASSERT_EQ(image.height, 16);
  ASSERT_EQ(image.channels, 2);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i)
      for (int k = 0; k < 2; ++k) {
        const StretchedTap& tap = table.texels[(j * 5 + i) * 2 + k];
        EXPECT_EQ(image.at(i, 8 * k + j)[0], static_cast<float>(tap.offset));
        EXPECT_EQ(image.at(i, 8 * k + j)[1], static_cast<float>(tap.perceptual_roughness));
        EXPECT_EQ(image.at(i, 8 * k + 4 + j)[0], static_cast<float>(tap.scale));
        EXPECT_EQ(image.at(i, 8 * k + 4 + j)[1], static_cast<float>(tap.bias));
      }
}

}  // namespace
}  // namespace welkin
