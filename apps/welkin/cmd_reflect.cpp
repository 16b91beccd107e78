#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <welkin/brdf/brdf_spec.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>
#include <welkin/parallel/parallel_for.h>

#include "commands.h"
#include "environment_options.h"
#include "flat_file.h"
#include "output_folder.h"
#include "progress.h"
#include "reflect_methods.h"
#include "reflect_stack.h"

// welkin reflect: how a surface of any BRDF reflects an environment, by a method of the literature, on a sphere; and how
// far that is from the integral over every texel.

namespace welkin {
namespace {

struct ReflectCommand {
  EnvironmentInput in;
  std::string brdf, method = "brute", output, stack;
  int size = 256, directions = 400;
  double error_bound = 0.02;
  bool verify = false;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<double> brute_force(const ReflectInput& input, std::span<const TangentQuery> queries) {
  if (input.anisotropic) return reflect_lafortune_brute_force(input.radiance, *input.anisotropic, queries);
  std::vector<ReflectionQuery> isotropic;
  for (const TangentQuery& query : queries) isotropic.push_back({query.normal, query.view});
  return reflect_brute_force(input.radiance, input.brdf, isotropic);
}

// The oracle in pieces, so that there is something to tell while it works.
std::vector<double> brute_force_with_progress(const ReflectInput& input,
                                              const std::vector<TangentQuery>& queries) {
  ProgressLine progress("summing over every texel");
  constexpr std::size_t piece = 64;
  std::vector<double> reflected;
  for (std::size_t first = 0; first < queries.size(); first += piece) {
    progress.show(static_cast<double>(first) / static_cast<double>(queries.size()));
    const auto part = std::span(queries).subspan(first, std::min(piece, queries.size() - first));
    const auto values = brute_force(input, part);
    reflected.insert(reflected.end(), values.begin(), values.end());
  }
  return reflected;
}

std::vector<double> reflect_all(const ReflectInput& input, const PreparedReflection& prepared,
                                const std::vector<TangentQuery>& queries) {
  std::vector<double> reflected(3 * queries.size());
  parallel_for(queries.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TangentQuery& query = queries[i];
      const auto rgb =
          input.anisotropic ? prepared.reflect_along(query) : prepared.reflect({query.normal, query.view});
      std::copy(rgb.begin(), rgb.end(), &reflected[3 * i]);
    }
  });
  return reflected;
}

// The grain of the sphere in pictures runs about the vertical axis.
Vec3 grain(Vec3 normal) {
  const Vec3 along = cross({0, 1, 0}, normal);
  const double size = length(along);
  return size > 1e-12 ? (1 / size) * along : Vec3{1, 0, 0};
}

// A picture of the sphere; what lies outside of its disc is black.
Image sphere_picture(const ReflectInput& input, const PreparedReflection* prepared, int size) {
  std::vector<TangentQuery> queries;
  std::vector<std::size_t> places;
  const auto all = sphere_picture_queries(size);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (length(all[i].normal) == 0) continue;
    queries.push_back({all[i].normal, grain(all[i].normal), all[i].view});
    places.push_back(i);
  }
  const auto reflected =
      prepared ? reflect_all(input, *prepared, queries) : brute_force_with_progress(input, queries);
  Image picture(size, size);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int c = 0; c < 3; ++c) picture.pixels[3 * places[i] + c] = static_cast<float>(reflected[3 * i + c]);
  return picture;
}

struct ReflectErrors {
  double mean = 0;           // of |error| over the mean of the truth
  double relative_rms = 0;   // RMS of the error over RMS of the truth
  double max_over_mean = 0;  // largest error over the mean of the truth
};

ReflectErrors measure(const std::vector<double>& values, const std::vector<double>& truth) {
  double absolute = 0, squares = 0, truth_sum = 0, truth_squares = 0, largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = std::abs(values[i] - truth[i]);
    absolute += error;
    squares += error * error;
    truth_sum += truth[i];
    truth_squares += truth[i] * truth[i];
    largest = std::max(largest, error);
  }
  if (truth_sum == 0) return {};
  return {absolute / truth_sum, std::sqrt(squares / truth_squares),
          largest * static_cast<double>(truth.size()) / truth_sum};
}

void print_header() {
  fmt::print("{:<14} {:>10} {:>10} {:>13} {:>9}  {}\n", "method", "prepare s", "mean error", "relative RMS",
             "max/mean", "what was prepared");
}

// Errors over random normals and views, one line for each method.
void verify(const ReflectInput& input, const std::vector<const ReflectMethod*>& methods, int directions,
            bool skip_unfit) {
  const auto queries = with_tangents(random_reflection_queries(directions, 1));
  const auto truth = brute_force_with_progress(input, queries);
  print_header();
  for (const ReflectMethod* method : methods) {
    const auto start = std::chrono::steady_clock::now();
    try {
      const PreparedReflection prepared = prepare(*method, input);
      const double seconds = seconds_since(start);
      const ReflectErrors errors = measure(reflect_all(input, prepared, queries), truth);
      fmt::print("{:<14} {:>10.3f} {:>10.2e} {:>13.2e} {:>9.2e}  {}\n", method->name, seconds, errors.mean,
                 errors.relative_rms, errors.max_over_mean, prepared.note);
    } catch (const Error& error) {
      if (!skip_unfit) throw;
      fmt::print("{:<14} {}\n", method->name, error.what());
    }
  }
}

void write_results(const ReflectCommand& command, const ReflectInput& input) {
  PreparedReflection prepared;
  if (command.method != "brute") prepared = prepare(find_reflect_method(command.method), input);
  if (!command.stack.empty()) write_stack(command.stack, prepared.stack(), command.in.input);
  if (command.output.empty()) return;
  const Image picture = sphere_picture(input, prepared.reflect ? &prepared : nullptr, command.size);
  write_file(command.output, encode_flat(command.output, picture));
}

void check_stack(const ReflectCommand& command) {
  if (command.stack.empty()) return;
  std::string choices;
  for (const ReflectMethod& method : reflect_methods()) {
    if (method.has_stack && method.name == command.method) return check_folder(command.stack);
    if (method.has_stack) choices += fmt::format("{}{}", choices.empty() ? "" : ", ", method.name);
  }
  throw CLI::ValidationError("--stack", "is for --method " + choices);
}

void check(const ReflectCommand& command) {
  if (command.output.empty() && command.stack.empty() && !command.verify)
    throw CLI::ValidationError("reflect", "has nothing to do: give -o FILE, --stack FOLDER or --verify");
  if (command.method == "all" && !command.output.empty())
    throw CLI::ValidationError("--method all", "is for --verify; choose one method for -o");
  if (command.method == "brute" && command.verify)
    throw CLI::ValidationError("--verify", "compares with brute; choose another method, or all");
  if (command.method != "brute" && command.method != "all") find_reflect_method(command.method);
  check_stack(command);
  if (command.output.empty()) return;
  check_flat_name(command.output);
  check_output(command.output, command.in.input);
}

void read_brdf(ReflectInput& input) {
  if (input.brdf_spec.rfind("lafortune:", 0) == 0) {
    LafortuneBrdf lobes = parse_lafortune(input.brdf_spec);
    if (!is_isotropic(lobes)) {
      input.anisotropic = std::move(lobes);
      return;
    }
  }
  input.brdf = parse_brdf(input.brdf_spec);
}

void run(const ReflectCommand& command) {
  check(command);
  ReflectInput input{{}, command.brdf, {}, {}, command.error_bound};
  read_brdf(input);
  if (input.anisotropic && command.method != "brute" && command.method != "all" &&
      command.method != "lafortune")
    prepare(find_reflect_method(command.method), input);  // which says so before any work
  Environment environment = load(command.in);
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: warning: {}: {}\n", command.in.input, warning);
  input.radiance = std::move(environment.radiance);
  if (command.verify) {
    std::vector<const ReflectMethod*> methods;
    for (const ReflectMethod& method : reflect_methods())
      if (command.method == "all" || command.method == method.name) methods.push_back(&method);
    verify(input, methods, command.directions, command.method == "all");
  }
  if (!command.output.empty() || !command.stack.empty()) write_results(command, input);
}

std::string method_help() {
  std::string text = "brute (every texel, the truth)";
  for (const ReflectMethod& method : reflect_methods())
    text += fmt::format(", {} ({})", method.name, method.what);
  return text + ", all (with --verify)";
}

}  // namespace

void add_reflect_command(CLI::App& app) {
  auto command = std::make_shared<ReflectCommand>();
  CLI::App* sub = app.add_subcommand(
      "reflect", "Show and measure how a BRDF reflects an environment, by several methods");
  add_environment_options(*sub, command->in);
  sub->add_option("--brdf", command->brdf, "What reflects: " + std::string(brdf_choices()))->required();
  sub->add_option("--method", command->method, method_help())->capture_default_str();
  sub->add_option("-o,--output", command->output,
                  "Picture of a sphere, seen along -Z: .hdr, .exr (radiance) or .png (tone-mapped)");
  sub->add_option("--stack", command->stack,
                  "Folder for what a renderer needs of lobes, lobes-2, lobes-published, single-lobe or "
                  "lafortune: cubes (.ktx2) and stack.json")
      ->check(must_be_a_name);
  sub->add_option("--size", command->size, "Pixels along a side of the picture")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  sub->add_option("--error-bound", command->error_bound,
                  "Relative RMS error that shrm chooses its orders for")
      ->check(must_be_finite)
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  sub->add_flag("--verify", command->verify, "Print errors against brute force over all normals and views");
  sub->add_option("--directions", command->directions, "How many pairs of normal and view --verify takes")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub->footer(
      "Examples:\n  welkin reflect sky: --brdf ggx:0.3,0.9 --method all --verify\n"
      "  welkin reflect park.hdr --brdf ward:0.2 --method lobes -o sphere.png\n"
      "  welkin reflect park.hdr --brdf ward:0.2 --method lobes --stack ward\n"
      "  welkin reflect park.hdr --brdf lafortune:-1:-0.6:0.9:64 --method lafortune --verify");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
