#include "ibl_manifest.h"

#include <cmath>

#include "lights_json.h"
#include "source_name.h"

#include <welkin/envmap/statistics.h>

namespace welkin {
namespace {

using Json = nlohmann::ordered_json;

Json input_json(const Environment& environment) {
  const MapStatistics s = map_statistics(environment.radiance);
  const Vec3 d = s.brightest_direction;
  return {{"width", environment.radiance.width},
          {"height", environment.radiance.height},
          {"mean_radiance", s.mean_radiance},
          {"max_radiance", s.max_radiance},
          {"brightest_direction", {d.x, d.y, d.z}},
          {"brightest_share", s.brightest_share},
          {"irradiance_up", s.irradiance_up},
          {"irradiance_down", s.irradiance_down},
          {"faults",
           {{"nan", environment.faults.nan},
            {"infinite", environment.faults.infinite},
            {"negative", environment.faults.negative}}},
          {"warnings", environment.warnings}};
}

Json conventions_json() {
  return {
      {"frame",
       "right-handed, +Y up, -Z forward (glTF); the middle column of an equirectangular map looks along +X"},
      {"faces", "+X -X +Y -Y +Z -Z, OpenGL and KTX orientation"},
      {"color", "linear, Rec. 709 primaries"},
      {"texel",
       "specular and irradiance: the value in the direction of the texel's centre; environment: the mean "
       "over the texel"},
      {"roughness", "alpha is the GGX width, alpha = perceptual_roughness^2"},
      {"stored_scale", "true value = value in the file * stored_scale"},
      {"spherical_harmonics", "see sh.json, which names its own"}};
}

Json errors_json(const LevelErrors& e) {
  Json json{{"relative_rms", e.relative_rms},
            {"max_over_mean", e.max_over_mean},
            {"energy", e.energy},
            {"lookup_relative_rms", e.lookup_relative_rms},
            {"lookup_max_over_mean", e.lookup_max_over_mean}};
  if (e.edge_step > 0) json["edge_step"] = e.edge_step;  // 0: too small to be measured
  return json;
}

Json stored_json(const StoredErrors& e) {
  Json json{{"relative_rms", e.relative_rms},
            {"max_over_mean", e.max_over_mean},
            {"energy", e.energy},
            {"face_step", e.face_step}};
  if (e.edge_step > 0) json["edge_step"] = e.edge_step;
  return json;
}

// What a consumer has to do for the fix-up.
const char* edge_lookup(EdgeFixup fixup) {
  switch (fixup) {
    case EdgeFixup::warp:
      return "before each look-up in a level of size N, the two components of the direction that are not the "
             "largest times (N - 1)/N";
    case EdgeFixup::average: return "as it is, with or without filtering across faces";
    default: return "with filtering across faces (seamless)";
  }
}

Json levels_json(const IblSet& set, const std::optional<IblErrors>& errors,
                 const std::optional<StoredSetErrors>& stored) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < set.levels.size(); ++k) {
    const IblLevel& level = set.levels[k];
    Json json{{"level", k},
              {"size", set.specular.levels[k].size},
              {"perceptual_roughness", level.perceptual_roughness},
              {"alpha", level.alpha},
              {"kernel", k == 0 ? "mirror: texel averages of the environment" : describe(level.kernel)}};
    if (k > 0) {
      json["degree"] = level.report.degree;
      json["seconds"] = level.report.seconds;
    }
    if (errors && k > 0) json["errors"] = errors_json(errors->levels[k]);
    if (errors && k == 0) json["errors"] = {{"energy", errors->levels[0].energy}};
    if (stored) json["stored_errors"] = stored_json(stored->specular[k]);
    levels.push_back(std::move(json));
  }
  return levels;
}

Json files_json(const std::vector<IblFile>& files) {
  Json list = Json::array();
  for (const IblFile& f : files) {
    Json json{{"name", f.name},
              {"quantity", f.quantity},
              {"unit", f.unit},
              {"format", f.format},
              {"size", f.size},
              {"level_count", f.level_count},
              {"stored_scale", f.stored_scale},
              {"clipped", f.clipped},
              {"bytes", f.bytes.size()}};
    if (!f.quality.empty()) json["quality"] = f.quality;
    list.push_back(std::move(json));
  }
  list.push_back({{"name", "sh.json"},
                  {"quantity", "spherical-harmonic coefficients of the radiance"},
                  {"format", "json"}});
  list.push_back(
      {{"name", "preview.png"}, {"quantity", "contact sheet shaded with these files"}, {"format", "png"}});
  list.push_back({{"name", "index.html"}, {"quantity", "this manifest as a page"}, {"format", "html"}});
  return list;
}

const char* method_name(DiffuseMethod method) {
  switch (method) {
    case DiffuseMethod::sh: return "sh";
    case DiffuseMethod::brute_force: return "brute";
    default: return "frequency";
  }
}

}  // namespace

Json make_manifest(const ManifestInput& in) {
  const IblSet& set = *in.set;
  const std::optional<IblErrors>& errors = *in.errors;
  Json json;
  json["generator"] = "welkin 0.1.0";
  json["source"] = source_name(in.environment->source);
  json["description"] = in.environment->description;
  json["orientation"] = {{"rotate_degrees", in.rotate_degrees}, {"mirror", in.mirror}};
  json["input"] = input_json(*in.environment);
  if (in.lights) {
    json["lights"] = lights_to_json(in.lights->lights);
    json["lights_note"] =
        "taken out of every map of this set: draw them beside it; irradiance of a surface = irradiance map + "
        "sum of light irradiance * max(0, cos)";
    if (in.recombination && !in.lights->lights.empty())
      json["lights_error"] = recombination_to_json(*in.recombination);
  }
  json["conventions"] = conventions_json();
  json["level_law"] = {{"name", name(in.options->law)},
                       {"formula", formula(in.options->law)},
                       {"levels", set.levels.size()},
                       {"size", set.specular.size()}};
  json["files"] = files_json(*in.files);
  const EdgeFixup fixup = in.file_options->edge_fixup;
  json["edges"] = {{"fixup", edge_fixup_name(fixup)}, {"lookup", edge_lookup(fixup)}};
  json["levels"] = levels_json(set, errors, *in.stored);
  json["irradiance"] = {{"size", set.irradiance.size}, {"method", method_name(in.options->diffuse)}};
  json["sh"] = {{"degree", set.radiance_sh.max_degree}};
  json["dfg"] = {{"size", set.dfg.size},
                 {"multiple_scattering_included", in.options->dfg_form != DfgForm::scale_bias}};
  if (*in.stored) json["irradiance"]["stored_errors"] = stored_json((*in.stored)->irradiance);
  if (errors) {
    json["irradiance"]["errors"] = errors_json(errors->irradiance);
    json["sh"]["irradiance_mean_error"] = errors->sh_mean;
    json["sh"]["irradiance_max_error"] = errors->sh_max;
    json["dfg"]["max_error"] = errors->dfg_max;
    if (!errors->trilinear_by_roughness.empty())
      json["trilinear"] = {{"relative_rms", errors->trilinear_relative_rms},
                           {"max_over_mean", errors->trilinear_max_over_mean},
                           {"by_roughness", errors->trilinear_by_roughness}};
  }
  double specular = set.filter.analysis_seconds;
  for (const IblLevel& level : set.levels) specular += level.report.seconds;
  json["timings"] = {{"load", in.load_seconds},  {"environment", set.seconds_environment},
                     {"specular", specular},     {"irradiance", set.seconds_irradiance},
                     {"sh", set.seconds_sh},     {"dfg", set.seconds_dfg},
                     {"total", in.total_seconds}};
  if (errors) json["timings"]["verify"] = errors->seconds;
  return json;
}

}  // namespace welkin
