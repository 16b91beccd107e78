#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "forms_sample.h"

#include <unistd.h>

// The source code that the forms are goes through compilers: C (and run), C++, GLSL and HLSL.

namespace welkin {
namespace {

class FormCompiles : public testing::Test {
 protected:
  FormCompiles()
      : folder_(std::filesystem::temp_directory_path() / ("welkin-forms-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~FormCompiles() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // Standard output and error of a command that runs in the folder, and has to succeed.
  std::string run(const std::string& command) const {
    const std::string line = "cd '" + folder_.string() + "' && { " + command + "; } > log.txt 2>&1";
    const int code = std::system(line.c_str());
    std::stringstream log;
    log << std::ifstream(folder_ / "log.txt").rdbuf();
    EXPECT_EQ(code, 0) << command << "\n" << log.str();
    return log.str();
  }

  const ShDocument document_ = random_document(21);

 private:
  std::filesystem::path folder_;
};

constexpr const char* c_main = R"(
#include <stdio.h>
#include "form.h"
int main(void) {
  const float n[3] = {0.48f, -0.6f, 0.64f};
  float rgb[3];
  welkin_irradiance_over_pi(n, rgb);
  printf("%.9g %.9g %.9g\n", (double)rgb[0], (double)rgb[1], (double)rgb[2]);
  return 0;
}
)";

TEST_F(FormCompiles, AsCAndGivesTheIrradiance) {
  write("form.h", write_sh(document_, ShForm::c));
  write("main.c", c_main);
  for (const char* language : {" -x c -std=c99", " -x c++ -std=c++11"}) {
    std::string command = WELKIN_COMPILER;
    command += language;
    command += " -Wall -Wextra -Wpedantic -Wconversion -Werror main.c -o main && ./main";
    std::istringstream output(run(command));
    std::array<double, 3> truth;
    evaluate(sh_of_quantity(document_.coefficients, ShQuantity::irradiance_over_pi), {0.48, -0.6, 0.64},
             truth);
    for (double expected : truth) {
      double value = 0;
      output >> value;
      EXPECT_NEAR(value, expected, 2e-6);  // nine terms of float
    }
  }
}

#define SKIP_WITHOUT_GLSLANG()             \
  if (std::string(WELKIN_GLSLANG).empty()) \
  GTEST_SKIP() << "glslangValidator (Debian glslang-tools) is not there"

TEST_F(FormCompiles, AsGlsl) {
  SKIP_WITHOUT_GLSLANG();
  const std::string main_function =
      "in vec3 n;\nout vec4 color;\n"
      "void main() { color = vec4(welkin_irradiance_over_pi(n) - welkin_irradiance_over_pi_4x4(n), 1.0); }\n";
  for (const char* version : {"#version 300 es\nprecision highp float;\n", "#version 330\n"}) {
    std::string shader = version;
    shader += write_sh(document_, ShForm::glsl);
    shader += main_function;
    write("form.frag", shader);
    run(WELKIN_GLSLANG " form.frag");
  }
}

TEST_F(FormCompiles, AsHlsl) {
  SKIP_WITHOUT_GLSLANG();
  write(
      "form.hlsl",
      write_sh(document_, ShForm::hlsl) +
          "float4 main(float3 n : NORMAL) : SV_Target { return float4(welkin_irradiance_over_pi(n), 1); }\n");
  run(WELKIN_GLSLANG " -D -V -e main -S frag -o form.spv form.hlsl");
}

// The matrices of the GLSL form, read from its text and evaluated, against the nine constants.
TEST(GlslMatrices, GiveTheSameAsTheConstants) {
  const ShDocument document = random_document(22);
  const std::string text = write_sh(document, ShForm::glsl);
  const ShCoefficients irradiance = sh_of_quantity(document.coefficients, ShQuantity::irradiance_over_pi);
  const char* names[] = {"red", "green", "blue"};
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string start = std::string("welkin_sh_") + names[c] + " = mat4(";
    const std::size_t begin = text.find(start);
    ASSERT_NE(begin, std::string::npos);
    std::istringstream numbers(text.substr(begin + start.size()));
    double m[4][4];
    for (auto& row : m)
      for (double& value : row) {
        char comma = 0;
        ASSERT_TRUE(numbers >> value >> comma);
      }
    for (int i = 0; i < 20; ++i) {
      const Vec3 n = normalized({normal(random), normal(random), normal(random)});
      const double v[4] = {n.x, n.y, n.z, 1};
      double value = 0;
      for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) value += v[row] * m[column][row] * v[column];
      std::array<double, 3> truth;
      evaluate(irradiance, n, truth);
      EXPECT_NEAR(value, truth[c], 1e-8);  // nine digits
    }
  }
}

}  // namespace
}  // namespace welkin
