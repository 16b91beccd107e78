#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/compare.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/equirect.h>

#include "commands.h"
#include "compare_pictures.h"
#include "environment_options.h"
#include "flat_file.h"
#include "json_text.h"
#include "source_name.h"

// welkin compare A B: how far A is from B, the reference; cubes level by level and face by face.

namespace welkin {
namespace {

constexpr std::array<const char*, 6> face_names{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

struct CompareCommand {
  std::string a, b, difference_path;
  std::string flip_path, report_path;
  double pixels_per_degree = 67;
  bool json = false, solid_angle = false, z_test = false, flip = false;

  bool looks() const { return flip || !flip_path.empty() || !report_path.empty(); }
};

// What was asked for beyond the table.
struct Extras {
  std::optional<ZTest> z;
  std::optional<PerceptualDifference> perceptual;
};

// One line of the report. A flat image is one part; a cube has one per level (face -1) and one per face of each level.
struct Part {
  int level = 0;
  int face = -1;
  int width = 0;
  int height = 0;
  ImageDifference difference;
};

std::string size_text(const LoadedImage& image) {
  if (!image.is_cube()) return fmt::format("a flat image of {} x {}", image.flat.width, image.flat.height);
  return fmt::format("a cube of {} with {} level{}", image.cube.size(), image.cube.levels.size(),
                     image.cube.levels.size() == 1 ? "" : "s");
}

void check_comparable(const CompareCommand& command, const LoadedImage& a, const LoadedImage& b) {
  if (size_text(a) == size_text(b)) return;
  throw Error(command.a, fmt::format("is {}, but {} is {}; convert one to the other's size first",
                                     size_text(a), command.b, size_text(b)));
}

std::vector<float> flat_weights(const Image& image) {
  std::vector<float> weights;
  for (int y = 0; y < image.height; ++y) {
    const double row = equirect_texel_solid_angle(image.width, image.height, y);
    weights.insert(weights.end(), static_cast<std::size_t>(image.width), static_cast<float>(row));
  }
  return weights;
}

std::vector<float> face_weights(int size) {
  std::vector<float> weights;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) weights.push_back(static_cast<float>(cube_texel_solid_angle(size, x, y)));
  }
  return weights;
}

Part compare_flat(const CompareCommand& command, const Image& a, const Image& b) {
  const std::vector<float> weights = command.solid_angle ? flat_weights(a) : std::vector<float>();
  return {0, -1, a.width, a.height, compare_images(a.pixels, b.pixels, a.channels, weights)};
}

void compare_level(const CompareCommand& command, int level, const Cube& a, const Cube& b,
                   std::vector<Part>& parts) {
  const std::vector<float> one = command.solid_angle ? face_weights(a.size) : std::vector<float>();
  std::vector<float> all;
  for (int face = 0; face < 6; ++face) all.insert(all.end(), one.begin(), one.end());
  parts.push_back({level, -1, a.size, a.size, compare_images(a.texels, b.texels, a.channels, all)});
  const std::size_t count = a.texels.size() / 6;
  for (int face = 0; face < 6; ++face) {
    const auto slice = [&](const Cube& cube) { return std::span(cube.texels).subspan(face * count, count); };
    parts.push_back({level, face, a.size, a.size, compare_images(slice(a), slice(b), a.channels, one)});
  }
}

std::vector<Part> compare_all(const CompareCommand& command, const LoadedImage& a, const LoadedImage& b) {
  if (!a.is_cube()) return {compare_flat(command, a.flat, b.flat)};
  std::vector<Part> parts;
  for (std::size_t i = 0; i < a.cube.levels.size(); ++i) {
    compare_level(command, static_cast<int>(i), a.cube.levels[i], b.cube.levels[i], parts);
  }
  return parts;
}

// JSON has no infinity: the PSNR of equal images and the relative error against black become null.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json part_json(const Part& part, bool cube) {
  nlohmann::ordered_json json;
  if (cube) json["level"] = part.level;
  if (cube && part.face >= 0) json["face"] = face_names[part.face];
  const ImageDifference& d = part.difference;
  const auto width = static_cast<std::size_t>(part.width);
  json["rmse"] = number(d.rmse);
  json["relative_rmse"] = number(d.relative_rmse);
  json["psnr_db"] = number(d.psnr_db);
  json["max_abs"] = number(d.max_abs);
  // Faces lie below each other in a whole level, so that y / size is the face.
  json["max_at"] = {{"x", d.max_pixel % width},
                    {"y", d.max_pixel / width},
                    {"channel", d.max_channel},
                    {"a", number(d.max_a)},
                    {"b", number(d.max_b)}};
  json["unequal_faults"] = d.unequal_faults;
  return json;
}

void print_json(const CompareCommand& command, const std::vector<Part>& parts, bool cube,
                const Extras& extras) {
  nlohmann::ordered_json json{{"a", command.a},
                              {"b", command.b},
                              {"kind", cube ? "cube" : "flat"},
                              {"weights", command.solid_angle ? "solid angle" : "equal"},
                              {"parts", nlohmann::ordered_json::array()}};
  for (const Part& part : parts) json["parts"].push_back(part_json(part, cube));
  if (extras.z) json["z_test"] = z_test_json(*extras.z);
  if (extras.perceptual) json["perceptual"] = perceptual_json(*extras.perceptual, command.pixels_per_degree);
  fmt::print("{}\n", json_text(json));
}

std::string part_name(const Part& part, bool cube) {
  if (!cube) return "image";
  return fmt::format("level {} {}", part.level, part.face < 0 ? "all" : face_names[part.face]);
}

void print_table(const std::vector<Part>& parts, bool cube) {
  fmt::print("{:<12} {:>10} {:>13} {:>9} {:>10}  {}\n", "", "RMSE", "relative RMSE", "PSNR dB", "maximum",
             "at x, y");
  for (const Part& part : parts) {
    const ImageDifference& d = part.difference;
    const auto width = static_cast<std::size_t>(part.width);
    fmt::print("{:<12} {:>10.3e} {:>13.3e} {:>9.2f} {:>10.3e}  {}, {}\n", part_name(part, cube), d.rmse,
               d.relative_rmse, d.psnr_db, d.max_abs, d.max_pixel % width, d.max_pixel / width);
    if (d.unequal_faults > 0) {
      fmt::print("{:<12} {} values are NaN or infinite in only one of the files and not in the figures\n", "",
                 d.unequal_faults);
    }
  }
}

// The six faces of the largest level, one below the other as they lie in memory.
Image column_of_faces(const Cube& cube) {
  Image image(cube.size, 6 * cube.size, cube.channels);
  image.pixels = cube.texels;
  return image;
}

OutputFile difference_file(const CompareCommand& command, const LoadedImage& a, const LoadedImage& b) {
  const auto picture = [](const LoadedImage& image) {
    return image.is_cube() ? column_of_faces(image.cube.levels.front()) : image.flat;
  };
  return {command.difference_path, encode_png(difference_image(picture(a), picture(b)))};
}

// Before any work: a name that says another format, and one that would overwrite what is compared.
void check_output_name(const CompareCommand& command, const std::string& option, const std::string& path,
                       const std::string& extension) {
  if (path.empty()) return;
  if (extension_of(path) != extension)
    throw CLI::ValidationError(option, "needs a name that ends in " + extension);
  std::error_code none;
  for (const std::string& input : {command.a, command.b})
    if (std::filesystem::equivalent(path, input, none))
      throw Error(input, "is compared and would be overwritten; choose another name for " + option);
  check_output(path, command.a);
}

void check(const CompareCommand& command) {
  check_output_name(command, "--diff", command.difference_path, ".png");
  check_output_name(command, "--flip-map", command.flip_path, ".png");
  check_output_name(command, "--report", command.report_path, ".html");
  if (!command.flip_path.empty() && command.flip_path == command.difference_path)
    throw CLI::ValidationError("--flip-map", "names the same file as --diff");
}

Extras compare_pictures(const CompareCommand& command, const LoadedImage& a, const LoadedImage& b,
                        const ImageDifference& figures, std::vector<OutputFile>& files) {
  Extras extras;
  if (!command.z_test && !command.looks()) return extras;
  if (a.is_cube()) throw Error(command.a, "is a cube; --z-test, --flip and --report compare flat pictures");
  if (command.z_test) extras.z = z_test_of_files(command.a, command.b, a, b);
  if (!command.looks()) return extras;
  CompareReport report{source_name(command.a),
                       source_name(command.b),
                       show_pictures(a, b),
                       {},
                       figures,
                       {},
                       command.pixels_per_degree,
                       extras.z};
  extras.perceptual = perceptual_difference(report.shown, command.pixels_per_degree);
  if (!command.flip_path.empty())
    files.push_back({command.flip_path, encode_png(perceptual_map_image(extras.perceptual->map))});
  if (!command.report_path.empty()) {
    report.perceptual = *extras.perceptual;
    report.difference = difference_image(a.flat, b.flat);
    const std::string page = compare_report_html(report);
    files.push_back({command.report_path, {page.begin(), page.end()}});
  }
  return extras;
}

void print_extras(const CompareCommand& command, const Extras& extras) {
  if (extras.perceptual)
    fmt::print(
        "\nperceptual difference at {:g} pixels a degree: mean {:.4f}, median {:.4f}, largest {:.4f}\n",
        command.pixels_per_degree, extras.perceptual->mean, extras.perceptual->median,
        extras.perceptual->largest);
  if (extras.z) print_z_test(*extras.z);
}

void run(const CompareCommand& command) {
  check(command);
  const LoadedImage a = load_file_or_sky(command.a), b = load_file_or_sky(command.b);
  for (const auto& [path, image] : {std::pair(&command.a, &a), std::pair(&command.b, &b)}) {
    for (const std::string& warning : image->warnings) {
      fmt::print(stderr, "welkin: warning: {}: {}\n", *path, warning);
    }
  }
  check_comparable(command, a, b);
  const std::vector<Part> parts = compare_all(command, a, b);
  std::vector<OutputFile> files;
  if (!command.difference_path.empty()) files.push_back(difference_file(command, a, b));
  const Extras extras = compare_pictures(command, a, b, parts.front().difference, files);
  write_files(files);
  if (command.json) return print_json(command, parts, a.is_cube(), extras);
  print_table(parts, a.is_cube());
  print_extras(command, extras);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* sub = app.add_subcommand("compare", "Measure how far an image or cube map is from a reference");
  sub->add_option("A", command->a, "The file to judge, or sky:...")->required();
  sub->add_option("B", command->b, "The reference, of the same size and kind, or sky:...")->required();
  sub->add_flag("--json", command->json, "Print JSON; null stands for infinity (the PSNR of equal images)");
  sub->add_flag("--solid-angle", command->solid_angle,
                "Weigh pixels by their solid angle; flat images are taken as equirectangular");
  sub->add_option(
      "--diff", command->difference_path,
      "Write |A - B| / RMS(B) as a PNG in false colours: black 1e-6 or less, white 100 or more, lightness "
      "by the logarithm; of a cube the largest level, its faces below each other");
  sub->add_flag("--z-test", command->z_test,
                "Whether pictures of welkin render differ by more than their standard errors (layer stderr "
                "of A, B or both)");
  sub->add_flag(
      "--flip", command->flip,
      "How different the pictures look, after FLIP (Andersson et al. 2020): 0 equal, 1 black against white");
  sub->add_option("--flip-map", command->flip_path,
                  "Write where they look different as a PNG in false colours");
  sub->add_option("--pixels-per-degree", command->pixels_per_degree, "From how far the pictures are seen")
      ->check(must_be_finite)
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  sub->add_option("--report", command->report_path,
                  "Write a page with the pictures, their differences and all figures");
  sub->footer(
      "Examples:\n  welkin compare specular.ktx2 reference.ktx2 --json --diff difference.png\n"
      "  welkin compare fast.exr reference.exr --z-test --flip --report difference.html");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
