#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include <welkin/image/image.h>

namespace welkin {

/// A set as its reader has it: true values, whatever the container and the scale.
struct LoadedSet {
  nlohmann::json manifest, sh;
  CubeMips environment, specular, irradiance;
  Image dfg;
};

/// Reads what `welkin ibl` wrote, going by manifest.json alone.
LoadedSet load_set(const std::filesystem::path& folder);

/// Fails the test unless the manifest names every file of the folder, and each has the size that it says.
void expect_complete(const std::filesystem::path& folder);

/// How far a stored value may be from the true one, by rounding alone. largest: of the pixel's channels.
double rounding(const std::string& format, double largest, double stored_scale);

/// Fails the test unless every value of `actual` is that of `expected` to the rounding of the format.
void expect_rounded(const CubeMips& actual, const CubeMips& expected, const std::string& format,
                    double stored_scale);

/// "timings" and "seconds" of a manifest, at any depth: all that may differ between two runs.
nlohmann::json without_times(const nlohmann::json& manifest);

}  // namespace welkin
