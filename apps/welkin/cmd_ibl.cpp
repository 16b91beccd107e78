#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "commands.h"
#include "environment_options.h"
#include "flat_file.h"
#include "ibl_files.h"
#include "ibl_manifest.h"
#include "ibl_preview.h"
#include "ibl_report.h"
#include "ibl_stored.h"
#include "json_text.h"
#include "light_options.h"
#include "lights_json.h"
#include "output_folder.h"
#include "progress.h"
#include "source_name.h"
#include "texture_options.h"

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/kernel_spec.h>
#include <welkin/envmap/verify.h>
#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>
#include <welkin/sh/forms/document.h>

// welkin ibl: the main job. One environment in, a complete image-based-lighting set out, measured if asked for.

namespace welkin {
namespace {

struct IblCommand {
  EnvironmentInput in;
  LightInput lights;
  std::string output;
  IblOptions options;
  std::string kernel = "ggx", law = "linear", diffuse = "frequency";
  std::string container = "ktx2", range = "scale", edge_fixup = "none";
  TextureInput texture;
  int zstd_level = 0;
  bool multiple_scattering = false, stretched_taps = false, verify = false;
  VerifyOptions verify_options;
  bool json = false;
};

DiffuseMethod parse_diffuse(const std::string& name) {
  return name == "sh"      ? DiffuseMethod::sh
         : name == "brute" ? DiffuseMethod::brute_force
                           : DiffuseMethod::frequency;
}

void print_levels(const IblSet& set, const std::optional<IblErrors>& errors) {
  fmt::print("level  size  roughness     alpha");
  fmt::print("{}\n", errors ? "   rel. RMS  max/mean    energy  edge step  look-up RMS" : "");
  for (std::size_t k = 0; k < set.levels.size(); ++k) {
    const IblLevel& level = set.levels[k];
    fmt::print("{:>5} {:>5} {:>10.4f} {:>9.5f}", k, set.specular.levels[k].size, level.perceptual_roughness,
               level.alpha);
    if (errors && k > 0) {
      const LevelErrors& e = errors->levels[k];
      fmt::print("   {:.2e}  {:.2e} {:>9.1e} {:>10} {:>12.2e}", e.relative_rms, e.max_over_mean, e.energy,
                 e.edge_step > 0 ? fmt::format("{:.3f}", e.edge_step) : "-", e.lookup_relative_rms);
    } else if (errors) {
      fmt::print("     mirror            {:>9.1e}", errors->levels[0].energy);
    }
    fmt::print("\n");
  }
}

void print_errors(const IblErrors& e) {
  fmt::print("irradiance map       relative RMS {:.2e}, largest {:.2e} of the mean\n",
             e.irradiance.relative_rms, e.irradiance.max_over_mean);
  fmt::print(
      "nine coefficients    irradiance off by {:.2f} % on average, {:.2f} % at most, of the largest "
      "irradiance\n",
      100 * e.sh_mean, 100 * e.sh_max);
  if (!e.trilinear_by_roughness.empty())
    fmt::print("trilinear look-up    relative RMS {:.2e} over random directions and roughnesses\n",
               e.trilinear_relative_rms);
  fmt::print("DFG table            largest error {:.1e} at texel centres\n", e.dfg_max);
  fmt::print("measured against brute force in double precision, {} directions, {:.1f} s\n", e.directions,
             e.seconds);
}

std::string edge_text(double step) { return step > 0 ? fmt::format("{:.3f}", step) : "-"; }

void print_stored(const IblSet& set, const StoredSetErrors& stored, const TextureInput& texture) {
  fmt::print("after writing as {}, against what was computed, every texel:\n", texture.format);
  fmt::print("level  size   rel. RMS  max/mean    energy  edge step  face step\n");
  const auto line = [](const std::string& name, int size, const StoredErrors& e) {
    fmt::print("{:>5} {:>5}   {:.2e}  {:.2e} {:>9.1e} {:>10}  {:.2e}\n", name, size, e.relative_rms,
               e.max_over_mean, e.energy, edge_text(e.edge_step), e.face_step);
  };
  for (std::size_t k = 0; k < stored.specular.size(); ++k)
    line(std::to_string(k), set.specular.levels[k].size, stored.specular[k]);
  line("irr.", set.irradiance.size, stored.irradiance);
}

void print_files(const std::vector<IblFile>& files) {
  for (const IblFile& f : files) {
    if (f.stored_scale != 1)
      fmt::print("note: {} is stored divided by {:g} to fit {}; multiply by it (the manifest{} so)\n", f.name,
                 f.stored_scale, f.format, f.name.ends_with(".ktx2") ? " and the file say" : " says");
    if (f.clipped > 0)
      fmt::print("note: {} values of {} were clipped to fit {}\n", f.clipped, f.name, f.format);
  }
}

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

// All files of the set, written only when everything is made; `out` may hold others that belong with it.
void write_set(const std::filesystem::path& directory, std::vector<IblFile>& files,
               const nlohmann::ordered_json& manifest, const std::string& input,
               std::vector<OutputFile> out) {
  for (IblFile& file : files) out.push_back({directory / file.name, std::move(file.bytes)});
  out.push_back({directory / "index.html", bytes_of(make_report_html(manifest))});
  out.push_back({directory / "manifest.json", bytes_of(json_text(manifest) + "\n")});
  std::error_code none;
  std::set<std::filesystem::path> names;
  for (const OutputFile& file : out)
    if (!names.insert(std::filesystem::absolute(file.path).lexically_normal()).second)
      throw Error(file.path.string(), "is a file of the set too; choose another name for --residual");
  for (const OutputFile& file : out)
    if (std::filesystem::equivalent(file.path, input, none))
      throw Error(input, "is the input and would be overwritten; choose another folder with -o");
  NewFolder folder(directory);
  write_files(out);
  folder.keep();
}

// What would fail only after all the work.
void check(const IblCommand& command) {
  check_container(command.texture, command.container);
  if (command.zstd_level > 0 && command.container != "ktx2")
    throw CLI::ValidationError("--zstd",
                               "is for --container ktx2; " + command.container + " has no such thing");
  const int most = std::bit_width(static_cast<unsigned>(command.options.size));
  if (command.options.levels > most)
    throw CLI::ValidationError("--levels",
                               fmt::format("a cube of {} has {} levels at most", command.options.size, most));
  if (command.stretched_taps && (command.kernel != "ggx" || command.options.levels == 1))
    throw CLI::ValidationError("--stretched-taps", "is for --kernel ggx and at least 2 levels");
  check_folder(command.output);
  const std::filesystem::path residual = command.lights.residual;
  if (residual.empty()) return;
  const auto folder = [](const std::filesystem::path& p) {
    return (std::filesystem::absolute(p) / "").lexically_normal();
  };
  if (folder(std::filesystem::absolute(residual).parent_path()) != folder(command.output))  // which is made
    check_output(residual.string(), command.in.input);
}

// The lights that were asked for, out of the environment.
struct Taken {
  std::optional<ExtractedLights> lights;
  RecombinationErrors errors;

  std::span<const DirectionalLight> list() const {
    return lights ? std::span<const DirectionalLight>(lights->lights) : std::span<const DirectionalLight>();
  }
};

Taken take_lights(const Environment& environment, const LightInput& in) {
  Taken taken;
  if (!in.wanted()) return taken;
  taken.lights = extract_lights(environment.radiance, in.options());
  taken.errors = check_recombination(environment.radiance, *taken.lights);
  const auto& left = taken.lights->residual.pixels;
  if (std::all_of(left.begin(), left.end(), [](float v) { return v == 0; }))
    throw Error(environment.source, "holds nothing but its lights; there is no map left to filter");
  return taken;
}

std::string sh_text(const IblSet& set, const Environment& environment, const Taken& taken) {
  ShDocument document;
  document.coefficients = set.radiance_sh;
  document.source = source_name(environment.source);
  for (const DirectionalLight& light : taken.list())
    document.lights.push_back({light.direction, light.irradiance, light.angular_radius});
  return write_sh(document, ShForm::json);
}

void print_taken(const Taken& taken) {
  print_lights(taken.lights->lights);
  if (taken.lights->lights.empty()) return;
  fmt::print(
      "set and lights give the map's irradiance back to {:.1e} of its largest (lights as directions; as "
      "discs "
      "{:.1e})\n",
      taken.errors.directional_max, taken.errors.disc_max);
}

void describe_taps(const StretchedTapsTable& taps, nlohmann::ordered_json& manifest) {
  manifest["stretched_taps"] = {
      {"taps", taps.taps}, {"cos_size", taps.cos_size}, {"roughness_size", taps.roughness_size}};
  manifest["files"].push_back(
      {{"name", "stretched_taps.glsl"}, {"quantity", "the shader of stretched_taps"}, {"format", "glsl"}});
}

void run(IblCommand command) {
  check(command);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  IblOptions& options = command.options;
  options.kernel = parse_kernel_family(command.kernel);
  options.law = parse_level_law(command.law);
  options.diffuse = parse_diffuse(command.diffuse);
  if (command.multiple_scattering) options.dfg_form = DfgForm::scale_bias_with_multiple_scattering;
  IblFileOptions file_options{parse_container(command.container),
                              command.texture.pixel_format(),
                              command.range == "clip" ? RangePolicy::clip : RangePolicy::scale,
                              command.zstd_level,
                              options.law,
                              nullptr,
                              command.texture.block_quality(),
                              edge_fixup_from_name(command.edge_fixup).value()};
  const Environment environment = load(command.in);
  const double load_seconds = seconds();
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", environment.source, warning);

  const Taken taken = take_lights(environment, command.lights);
  const Image& radiance = taken.lights ? taken.lights->residual : environment.radiance;
  std::optional<ProgressLine> progress(std::in_place, "filtering " + environment.source);
  options.filter.progress = [&](double share) { progress->show(command.verify ? 0.3 * share : share); };
  const IblSet set = make_ibl(radiance, options);
  std::optional<IblErrors> errors;
  if (command.verify) {
    VerifyOptions verify = command.verify_options;
    verify.progress = [&](double share) { progress->show(0.3 + 0.7 * share); };
    errors = verify_ibl(set, radiance, options, verify);
  }
  progress.reset();  // its line would run into what is printed from here on
  for (std::size_t k = 1; k < set.levels.size(); ++k)
    if (!set.levels[k].report.bound_met)
      fmt::print(
          stderr,
          "welkin: {}: warning: level {} could not be filtered to the error bound; check it with --verify\n",
          environment.source, k);
  std::optional<StretchedTapsTable> taps;
  if (command.stretched_taps)
    taps = make_stretched_taps_table(
        {set.specular.size(), static_cast<int>(set.specular.levels.size()), options.law});
  if (taps) file_options.taps = &*taps;
  std::vector<IblFile> files = encode_ibl_files(set, file_options);
  std::optional<StoredSetErrors> stored;
  if (command.verify) stored = measure_stored(set, files, file_options);
  const ManifestInput described{&environment,
                                command.in.options.rotate_degrees,
                                command.in.options.mirror,
                                &set,
                                &options,
                                &files,
                                &errors,
                                &file_options,
                                &stored,
                                taken.lights ? &*taken.lights : nullptr,
                                &taken.errors,
                                load_seconds,
                                seconds()};
  nlohmann::ordered_json manifest = make_manifest(described);
  if (taps) describe_taps(*taps, manifest);
  const std::filesystem::path folder = command.output;
  std::vector<OutputFile> others{{folder / "sh.json", bytes_of(sh_text(set, environment, taken))},
                                 {folder / "preview.png", encode_png(make_preview(set, taken.list()))}};
  if (taps) others.push_back({folder / "stretched_taps.glsl", bytes_of(stretched_taps_glsl(*taps))});
  if (!command.lights.residual.empty())
    others.push_back({command.lights.residual, encode_flat(command.lights.residual, radiance)});
  write_set(command.output, files, manifest, environment.source, std::move(others));
  if (command.json) {
    fmt::print("{}\n", json_text(manifest));
    return;
  }
  if (taken.lights) print_taken(taken);
  print_levels(set, errors);
  if (errors) print_errors(*errors);
  if (stored) print_stored(set, *stored, command.texture);
  print_files(files);
  fmt::print("wrote {} in {:.2f} s: open {}\n", command.output, seconds(),
             (std::filesystem::path(command.output) / "index.html").string());
}

}  // namespace

void add_ibl_command(CLI::App& app) {
  auto command = std::make_shared<IblCommand>();
  CLI::App* sub = app.add_subcommand("ibl", "Make a complete image-based-lighting set from an environment");
  add_environment_options(*sub, command->in);
  add_light_options(*sub, command->lights);
  IblOptions& o = command->options;
  sub->add_option("-o,--output", command->output, "Folder for the set; made if it is missing")->required();
  sub->add_option("--size", o.size, "Texels along an edge of the largest level")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  sub->add_option("--levels", o.levels, "Levels of the specular map; 0 chooses those down to 4 texels")
      ->check(CLI::Range(0, 14));
  sub->add_option("--kernel", command->kernel, "ggx, phong, blinn-phong, gaussian or vmf")
      ->check(CLI::IsMember({"ggx", "phong", "blinn-phong", "gaussian", "vmf"}))
      ->capture_default_str();
  sub->add_option("--level-law", command->law,
                  "Which level a roughness is in: linear, quadratic (Filament, three.js), log2 (Babylon.js)")
      ->check(CLI::IsMember({"linear", "quadratic", "log2"}))
      ->capture_default_str();
  sub->add_option("--irradiance-size", o.irradiance_size, "Texels along an edge of the irradiance map")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  sub->add_option("--diffuse", command->diffuse,
                  "How the irradiance map is made: frequency (exact), sh (nine coefficients), brute (slow)")
      ->check(CLI::IsMember({"frequency", "sh", "brute"}))
      ->capture_default_str();
  sub->add_option("--sh-degree", o.sh_degree, "Degree of the coefficients in sh.json")
      ->check(CLI::Range(0, max_projection_degree))
      ->capture_default_str();
  sub->add_option("--dfg-size", o.dfg_size, "Texels along an edge of the DFG table")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  sub->add_flag("--dfg-multiple-scattering", command->multiple_scattering,
                "Put the light that scatters between facets into the DFG table; without it, shaders add it "
                "(see docs/ibl.md)");
  sub->add_flag("--stretched-taps", command->stretched_taps,
                "Write stretched_taps and its shader: three look-ups of specular in place of one, a third "
                "of the split sum's error or less (see docs/reflection.md)");
  add_texture_options(*sub, command->texture, "Of the cubes", false);
  sub->add_option(
         "--edge-fixup", command->edge_fixup,
         "For samplers that do not filter across faces: warp (the shader scales directions) or average")
      ->check(CLI::IsMember({"none", "warp", "average"}))
      ->capture_default_str();
  sub->add_option("--container", command->container, "ktx2, dds or exr")
      ->check(CLI::IsMember({"ktx2", "dds", "exr"}))
      ->capture_default_str();
  sub->add_option("--range", command->range,
                  "Values too large for the format: scale (store all divided by a power of two) or clip")
      ->check(CLI::IsMember({"scale", "clip"}))
      ->capture_default_str();
  sub->add_option("--zstd", command->zstd_level,
                  "Compress KTX2 levels with Zstandard, 1 (fast) to 22 (small); 0 does not")
      ->check(CLI::Range(0, 22))
      ->capture_default_str();
  sub->add_flag("--verify", command->verify,
                "Measure every output against brute force, print and store the errors");
  sub->add_option("--verify-directions", command->verify_options.directions,
                  "Random directions per level for --verify")
      ->check(CLI::Range(4, 100000))
      ->capture_default_str();
  sub->add_flag("--json", command->json, "Print the manifest in place of the table");
  sub->footer(
      "Examples:\n  welkin ibl park.hdr -o park --verify\n  welkin ibl sky:day,elevation=20 -o day --size "
      "512 --container dds\n  welkin ibl park.hdr -o park --extract-sun");
  sub->callback([command, sub] {
    check_light_options(command->lights, *sub);
    run(*command);
  });
}

}  // namespace welkin
