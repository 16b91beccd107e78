#include <welkin/realtime/ibl_folder.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include <welkin/error.h>
#include <welkin/image/load.h>
#include <welkin/sh/forms/document.h>
#include <welkin/sphere/cube_layout.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_manifest(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw Error(path.string(), "cannot be read; a folder of `welkin ibl` has it");
  json manifest = json::parse(file, nullptr, false);
  if (!manifest.is_object()) throw Error(path.string(), "is not a JSON object");
  return manifest;
}

// The set's maps, level by level, as they come.
struct Files {
  CubeMips environment, specular, irradiance;
  Image dfg;
};

// The readers of ktx2 and exr apply the scale that the file names; dds has no place for one.
CubeMips read_cubes(const fs::path& path, double stored_scale) {
  LoadedImage loaded = load_image(path);
  if (!loaded.is_cube()) loaded.cube.levels = {cube_from_layout(loaded.flat, CubeLayout::horizontal_strip)};
  if (path.extension() == ".dds")
    for (Cube& level : loaded.cube.levels)
      for (float& value : level.texels) value *= static_cast<float>(stored_scale);
  return std::move(loaded.cube);
}

void append(CubeMips& to, CubeMips&& from) {
  for (Cube& level : from.levels) to.levels.push_back(std::move(level));
}

Files read_files(const fs::path& folder, const json& manifest) {
  Files files;
  for (const json& file : manifest.at("files")) {
    const std::string name = file.at("name");
    const fs::path path = folder / fs::path(name).filename();
    const std::string content = name.substr(0, name.find_first_of("_."));
    const double scale = file.value("stored_scale", 1.0);
    if (content == "environment") append(files.environment, read_cubes(path, scale));
    if (content == "specular") append(files.specular, read_cubes(path, scale));
    if (content == "irradiance") append(files.irradiance, read_cubes(path, scale));
    if (content == "dfg") files.dfg = load_image(path).flat;
  }
  return files;
}

void check(const fs::path& folder, const json& manifest, const Files& files) {
  const auto refuse = [&](const std::string& why) { throw Error(folder.string(), why); };
  if (files.environment.empty() || files.specular.empty() || files.irradiance.empty())
    refuse("has no environment, specular or irradiance map in its manifest");
  if (files.specular.levels.size() < 2)
    refuse("has one level of the specular map; the renderer needs two or more");
  if (manifest.at("levels").size() != files.specular.levels.size())
    refuse("has a manifest with another number of levels than its specular map");
  const std::string kernel = manifest.at("levels").at(1).at("kernel");
  if (kernel.rfind("ggx", 0) != 0)
    refuse("has a specular map of the kernel " + kernel +
           "; the renderer looks up ggx (welkin ibl --kernel ggx)");
  if (manifest.contains("edges") && manifest["edges"].value("fixup", "none") == "warp")
    refuse(
        "has texels moved to the edges of their faces (--edge-fixup warp), which no cube look-up of OpenGL "
        "ES wants");
}

// The sphere again as one picture, with as many texels round the horizon as the four faces there have, twice over.
Image equirect_of(const Cube& environment) {
  const int width = std::clamp(4 * environment.size, 16, 2048);
  Image map = cube_to_equirect(environment, width, width / 2);
  for (float& value : map.pixels) value = std::max(0.0f, value);
  return map;
}

DfgTable dfg_of(const fs::path& folder, const Image& image, bool with_multiple_scattering) {
  if (with_multiple_scattering || image.empty()) return make_dfg_table({image.empty() ? 128 : image.width});
  if (image.width != image.height || image.channels < 2)
    throw Error(folder.string(), "has a DFG table that is not square");
  DfgTable table;
  table.size = image.width;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    table.scale_bias.push_back(image.pixels[i]);
    table.scale_bias.push_back(image.pixels[i + 1]);
  }
  return table;
}

// As the set's file has them, which were made from the original; else from the cube.
ShCoefficients radiance_sh(const fs::path& folder, const Image& radiance) {
  const fs::path path = folder / "sh.json";
  if (fs::exists(path)) {
    const ShDocument document = read_sh_file(path);
    if (document.quantity == ShQuantity::radiance && document.coefficients.max_degree >= 2 &&
        document.coefficients.channels == 3)
      return document.coefficients;
  }
  return project_equirect(radiance, 2);
}

IblFolder load(const fs::path& folder) {
  const json manifest = read_manifest(folder / "manifest.json");
  Files files = read_files(folder, manifest);
  check(folder, manifest, files);
  auto light = std::make_shared<EnvironmentData>();
  light->law = parse_level_law(manifest.at("level_law").at("name").get<std::string>());
  light->radiance = equirect_of(files.environment.levels[0]);
  light->maps.dfg =
      dfg_of(folder, files.dfg, manifest.at("dfg").value("multiple_scattering_included", false));
  light->maps.radiance_sh = radiance_sh(folder, light->radiance);
  light->maps.environment = build_mips(std::move(files.environment.levels[0]));
  light->maps.specular = std::move(files.specular);
  light->maps.irradiance = std::move(files.irradiance.levels[0]);
  IblFolder loaded{light, {}};
  const std::size_t lights = manifest.contains("lights") ? manifest["lights"].size() : 0;
  if (lights > 0)
    loaded.warnings.push_back(folder.string() + ": " + std::to_string(lights) +
                              " lights were taken out of this set; they are not drawn");
  return loaded;
}

}  // namespace

bool is_ibl_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path / "manifest.json", none);
}

IblFolder load_ibl_folder(const fs::path& folder) {
  try {
    return load(folder);
  } catch (const json::exception&) {
    throw Error((folder / "manifest.json").string(),
                "lacks a field of a manifest of `welkin ibl`, or has another type there");
  }
}

}  // namespace welkin
