#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "beside.h"
#include "commands.h"
#include "cube_file.h"
#include "environment_options.h"
#include "flat_file.h"
#include "method_options.h"
#include "progress.h"

#include <welkin/envmap/kernel_spec.h>
#include <welkin/envmap/methods/filter_truth.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>

// welkin filter: one filtered cube by any method, and the table of all methods.

namespace welkin {
namespace {

struct FilterCommand {
  EnvironmentInput in;
  std::string kernel = "ggx:0.25", method = "frequency", output, beside;
  int size = 128, texels = 64;
  double scale = 1;
  bool verify = false;
  CubeFileOptions file;
  FilterMethodOptions options;
};

bool compares_all(const FilterCommand& command) { return command.method == "all"; }

// Before any work: what says nothing together.
void check(const FilterCommand& command, const CLI::App& sub) {
  const bool writes = !command.output.empty() || !command.beside.empty();
  if (compares_all(command) && writes)
    throw CLI::ValidationError("--method all", "compares and writes nothing: leave out -o and --beside");
  if (!compares_all(command) && !command.verify && !writes)
    throw CLI::ValidationError("-o", "name a file to write, or ask for --verify");
  if (!command.beside.empty() && extension_of(command.beside) != ".png")
    throw CLI::ValidationError("--beside", command.beside + " is not a .png");
  std::optional<FilterMethod> method;
  if (!compares_all(command)) method = parse_filter_method(command.method);
  check_method_options(sub, method);
  check_output(command.beside, command.in.input);
  if (command.output.empty()) return;
  check_cube_name(command.output);
  check_output(command.output, command.in.input);
}

struct Filtered {
  Cube cube;
  double milliseconds = 0;
};

Filtered filter(const FilterCommand& command, const Image& radiance, const FilterTarget& target,
                FilterMethod method) {
  ProgressLine progress("filtering, " + std::string(filter_method_name(method)));
  FilterMethodOptions options = command.options;
  const auto show = [&](double share) { progress.show(share); };
  options.brute.progress = options.frequency.progress = show;
  options.angular.progress = options.hierarchical.progress = show;
  const auto start = std::chrono::steady_clock::now();
  Filtered result{filter_by_method(radiance, target, method, options), 0};
  result.milliseconds =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void print_heading(const FilterTarget& target) {
  fmt::print("{}, {} x {} x 6\n", describe(target.kernel), target.size, target.size);
  fmt::print("method            ms   rel. RMS  max/mean  edge step\n");
}

void print_line(FilterMethod method, double milliseconds, const FilterErrors& errors) {
  fmt::print("{:<12} {:>9.4g}   {:.2e}  {:.2e}  {:>9}\n", filter_method_name(method), milliseconds,
             errors.relative_rms, errors.max_over_mean,
             errors.edge_step > 0 ? fmt::format("{:.3f}", errors.edge_step) : "-");
  std::fflush(stdout);
}

void print_truth(const FilterTruth& truth) {
  fmt::print("against brute force at {} texels anywhere (RMS) and {} near the brightest light\n",
             truth.anywhere, truth.texels.size() - truth.anywhere);
}

// Brute force itself would take as long as all others together many times over: its time is that of the texels that
// were needed, multiplied up.
void print_all(const FilterCommand& command, const Image& radiance, const FilterTarget& target) {
  const FilterTruth truth = make_filter_truth(radiance, target, command.texels);
  print_heading(target);
  const double share = 6.0 * target.size * target.size / static_cast<double>(truth.texels.size());
  fmt::print("{:<12} {:>9.4g}   {:<8}  {:<8}  {:>9}\n", "brute", 1000 * truth.seconds * share, "the truth",
             "", "");
  for (FilterMethod method : filter_methods()) {
    if (method == FilterMethod::brute) continue;
    const Filtered result = filter(command, radiance, target, method);
    print_line(method, result.milliseconds, compare_with_truth(result.cube, truth));
  }
  print_truth(truth);
}

// The truth is that of frequency, whose error (1e-4) no picture shows.
void write_beside(const FilterCommand& command, const Image& radiance, const FilterTarget& target,
                  const Cube& cube) {
  const Cube truth = filter_by_method(radiance, target, FilterMethod::frequency);
  write_file(command.beside, draw_beside(truth, cube, command.method));
}

void run(const FilterCommand& command, const CLI::App& sub) {
  check(command, sub);
  const FilterTarget target{parse_kernel(command.kernel), command.size, command.scale};
  const Environment environment = load(command.in);
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", environment.source, warning);
  if (compares_all(command)) return print_all(command, environment.radiance, target);
  const FilterMethod method = parse_filter_method(command.method);
  const Filtered result = filter(command, environment.radiance, target, method);
  if (!command.output.empty()) write_cube_file(command.output, result.cube, command.file);
  if (!command.beside.empty()) write_beside(command, environment.radiance, target, result.cube);
  if (!command.verify) return;
  const FilterTruth truth = make_filter_truth(environment.radiance, target, command.texels);
  print_heading(target);
  print_line(method, result.milliseconds, compare_with_truth(result.cube, truth));
  print_truth(truth);
}

std::string method_names() {
  std::string names;
  for (FilterMethod method : filter_methods()) names += std::string(filter_method_name(method)) + ", ";
  return names;
}

std::string known_method(const std::string& name) {
  if (name == "all") return "";
  try {
    parse_filter_method(name);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

void add_filter_command(CLI::App& app) {
  auto command = std::make_shared<FilterCommand>();
  CLI::App* sub = app.add_subcommand("filter", "Filter a map by one kernel, by any method; compare methods");
  add_environment_options(*sub, command->in);
  sub->add_option("--kernel", command->kernel, kernel_spec_help())->capture_default_str();
  sub->add_option("--method", command->method, method_names() + "or all: a table that compares them")
      ->check(known_method)
      ->capture_default_str();
  sub->add_option("--size", command->size, "Texels along an edge of the cube")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  sub->add_option("--scale", command->scale,
                  "Multiplies everything; 3.14159265 with --kernel lambert is irradiance")
      ->check(must_be_finite)
      ->check(CLI::Range(1e-30, 1e30))
      ->capture_default_str();
  sub->add_option("-o,--output", command->output, "File to write: .ktx2, .dds, .exr, .hdr or .png")
      ->check(must_be_a_name);
  sub->add_option("--beside", command->beside,
                  "A .png for looking at: the truth, the result and their difference, beside each other")
      ->check(must_be_a_name);
  sub->add_option("--format", command->file.format, "Texels of .ktx2 and .dds")
      ->check(CLI::IsMember({"rgba16f", "rgba32f", "rgb9e5"}))
      ->capture_default_str();
  sub->add_option("--layout", command->file.layout, "How the cube lies in a picture")
      ->check(CLI::IsMember({"hcross", "vcross", "hstrip", "vstrip"}))
      ->capture_default_str();
  sub->add_flag("--verify", command->verify, "Print time and error against brute force");
  sub->add_option("--texels", command->texels, "How many texels --verify takes, or all of a smaller cube")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  add_method_options(*sub, command->options);
  sub->footer(
      "Examples:\n  welkin filter park.hdr --kernel phong:225 --size 256 -o glossy.ktx2 --verify\n"
      "  welkin filter sky:day --kernel ggx:0.25 --method all --size 32");
  sub->callback([command, sub] { run(*command, *sub); });
}

}  // namespace welkin
