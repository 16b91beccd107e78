#include <welkin/envmap/kernel_spec.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include <welkin/error.h>

namespace welkin {
namespace {

TEST(KernelSpec, ReadsEveryForm) {
  EXPECT_EQ(describe(parse_kernel("ggx:0.25")), "ggx alpha 0.25");
  EXPECT_EQ(describe(parse_kernel("phong:225")), "phong exponent 225");
  EXPECT_EQ(describe(parse_kernel("blinn-phong:12.5")), "blinn-phong exponent 12.5");
  EXPECT_EQ(describe(parse_kernel("vmf:100")), "vmf kappa 100");
  EXPECT_EQ(describe(parse_kernel("lambert")), "lambert");
  EXPECT_NEAR(parse_kernel("gaussian:5deg").parameter, std::numbers::pi / 36, 1e-15);
  EXPECT_EQ(parse_kernel("gaussian:0.1").parameter, 0.1);
}

TEST(KernelSpec, ReadsATableFromAFile) {
  const auto path = std::filesystem::temp_directory_path() / "welkin_kernel_spec_test.csv";
  std::ofstream(path) << "0 1\n30 0.2\n60 0\n";
  const ZonalKernel kernel = parse_kernel("table:" + path.string());
  std::filesystem::remove(path);
  EXPECT_EQ(describe(kernel), "table of 3 angles");
  EXPECT_THROW(parse_kernel("table:" + path.string()), Error);
}

TEST(KernelSpec, NamesTheChoices) {
  for (const char* bad : {"", "ggx", "ggx:", "cosine:3", "lambert:1", ":", "table:"}) {
    try {
      parse_kernel(bad);
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("blinn-phong:N"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parse_kernel("ggx:x"), Error);
  EXPECT_THROW(parse_kernel("ggx:0.5x"), Error);
  EXPECT_THROW(parse_kernel("gaussian:deg"), Error);
  EXPECT_THROW(parse_kernel("phong:nan"), Error);
  EXPECT_THROW(parse_kernel_family("lambert"), Error);
  EXPECT_EQ(parse_kernel_family("vmf"), KernelKind::von_mises_fisher);
}

}  // namespace
}  // namespace welkin
