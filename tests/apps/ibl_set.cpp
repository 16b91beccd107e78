#include "ibl_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "run_command.h"

#include <welkin/image/load.h>
#include <welkin/sphere/cube_layout.h>

namespace welkin {
namespace {

// Only DDS cannot name its scale; the readers of the others have applied it.
void apply_scale(const std::filesystem::path& path, double scale, CubeMips& cube) {
  if (path.extension() != ".dds") return;
  for (Cube& level : cube.levels)
    for (float& value : level.texels) value *= static_cast<float>(scale);
}

// One level of an OpenEXR set, or all levels of a cube.
void add_levels(const std::filesystem::path& path, const nlohmann::json& file, CubeMips& cube) {
  LoadedImage loaded = load_image(path);
  if (!loaded.is_cube()) loaded.cube.levels = {cube_from_layout(loaded.flat, CubeLayout::horizontal_strip)};
  EXPECT_EQ(loaded.cube.levels.size(), file["level_count"]) << path;
  EXPECT_EQ(loaded.cube.size(), file["size"]) << path;
  apply_scale(path, file["stored_scale"], loaded.cube);
  for (Cube& level : loaded.cube.levels) cube.levels.push_back(std::move(level));
}

void expect_rounded(const Cube& actual, const Cube& expected, const std::string& format,
                    double stored_scale) {
  ASSERT_EQ(actual.size, expected.size);
  ASSERT_EQ(actual.texels.size(), expected.texels.size());
  double worst = 0;  // error over what rounding allows
  for (std::size_t i = 0; i < expected.texels.size(); i += 3) {
    const float* truth = &expected.texels[i];
    const double allowed = rounding(format, *std::max_element(truth, truth + 3), stored_scale);
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(double{actual.texels[i + c]} - truth[c]) / allowed);
  }
  EXPECT_LE(worst, 1) << "level of " << expected.size << " in " << format;
}

}  // namespace

LoadedSet load_set(const std::filesystem::path& folder) {
  LoadedSet set;
  set.manifest = nlohmann::json::parse(read_text(folder / "manifest.json"));
  set.sh = nlohmann::json::parse(read_text(folder / "sh.json"));
  for (const auto& file : set.manifest["files"]) {
    const std::string name = file["name"];
    const std::string content = name.substr(0, name.find_first_of("_."));
    if (content == "environment") add_levels(folder / name, file, set.environment);
    if (content == "specular") add_levels(folder / name, file, set.specular);
    if (content == "irradiance") add_levels(folder / name, file, set.irradiance);
    if (content == "dfg") set.dfg = load_image(folder / name).flat;
  }
  return set;
}

void expect_complete(const std::filesystem::path& folder) {
  const auto files = files_below(folder);
  ASSERT_TRUE(files.contains("manifest.json"));
  const auto manifest = nlohmann::json::parse(files.at("manifest.json"));
  std::set<std::string> named{"manifest.json"}, present;
  for (const auto& [name, bytes] : files) present.insert(name);
  for (const auto& file : manifest["files"]) named.insert(file["name"].get<std::string>());
  EXPECT_EQ(named, present);
  for (const auto& file : manifest["files"]) {
    const std::size_t size = files.at(file["name"]).size();
    EXPECT_EQ(file.value("bytes", size), size) << file;
    EXPECT_GT(size, 0u) << file;
  }
}

// Half floats have 11 bits, steps of 2^-24 near zero. rgb9e5 has 9 bits for the largest channel of a pixel (256 to 511
// steps), the others share its step, at least 2^-24. r11g11b10f's blue has 6 bits, steps of 2^-19 near zero. Single floats are written as they are; the smallest number stands
// for 0.
double rounding(const std::string& format, double largest, double stored_scale) {
  const double least = stored_scale * std::exp2(-25);
  if (format == "rgba16f") return std::max(largest * std::exp2(-11), least);
  if (format == "r11g11b10f") return std::max(largest / 64, stored_scale * std::exp2(-20));
  if (format == "rgb9e5") return std::max(largest / 511, least);
  return 1e-300;
}

void expect_rounded(const CubeMips& actual, const CubeMips& expected, const std::string& format,
                    double stored_scale) {
  ASSERT_EQ(actual.levels.size(), expected.levels.size());
  for (std::size_t k = 0; k < expected.levels.size(); ++k)
    expect_rounded(actual.levels[k], expected.levels[k], format, stored_scale);
}

nlohmann::json without_times(const nlohmann::json& manifest) {
  nlohmann::json result = manifest;
  if (!result.is_structured()) return result;
  if (result.is_object()) {
    result.erase("timings");
    result.erase("seconds");
  }
  for (auto& member : result) member = without_times(member);
  return result;
}

}  // namespace welkin
