#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "commands.h"
#include "environment_options.h"
#include "flat_file.h"
#include "light_options.h"
#include "lights_json.h"
#include "sh_fit.h"
#include "source_name.h"

#include <welkin/envmap/light_fit.h>
#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/forms/document.h>

// welkin sh: spherical-harmonic coefficients of an environment, or of a file of coefficients in any form, with their
// conventions named, in the form that an engine reads.

namespace welkin {
namespace {

struct ShCommand {
  EnvironmentInput in;
  LightInput lights;
  int fitted_lights = 0;
  ShFitOptions fit;
  std::optional<int> degree;            // 2 for an environment, as it is for a file
  std::optional<std::string> quantity;  // radiance for an environment, as it is for a file
  std::string form, form_in, output, json_path;
  bool faults_given = false;
};

std::vector<std::string> form_names() {
  std::vector<std::string> names;
  names.reserve(all_sh_forms.size());
  for (ShForm form : all_sh_forms) names.emplace_back(sh_form_name(form));
  return names;
}

// An engine's form fixes its quantity and its degree; asking for others is a misunderstanding.
void check_usage(const ShCommand& command) {
  if (command.fitted_lights > 0 && command.degree && *command.degree != 2)
    throw CLI::ValidationError("--fit-lights", "is for degree 2");
  if (command.degree.value_or(0) > 2 && !fits_any_degree(command.fit))
    throw CLI::ValidationError("--fit", command.fit.name + " is for degree 2; hann and lanczos take any");
  if (command.form.empty()) {
    if (!command.output.empty()) throw CLI::ValidationError("-o", "needs --form: which form shall it have?");
    return;
  }
  if (command.form == "json") return;
  if (command.quantity)
    throw CLI::ValidationError("--quantity",
                               "is fixed by --form " + command.form + "; only json has a choice");
  if (command.degree && *command.degree != 2)
    throw CLI::ValidationError("--degree", "is 2 in --form " + command.form + "; only json has a choice");
}

// Of all images, only Radiance HDR begins as text.
bool is_plain_text(std::span<const std::uint8_t> bytes) {
  if (bytes.empty() || (bytes.size() > 1 && bytes[0] == '#' && bytes[1] == '?')) return false;
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t c) {
    return (c >= ' ' && c <= '~') || c == '\t' || c == '\n' || c == '\r';
  });
}

// By its first bytes. What is no regular file, a pipe, can be read only once: there --form-in decides.
bool is_coefficient_file(const ShCommand& command) {
  if (!command.form_in.empty()) return true;
  std::error_code error;
  if (is_sky_spec(command.in.input) || !std::filesystem::is_regular_file(command.in.input, error))
    return false;
  std::ifstream file(command.in.input, std::ios::binary);
  std::vector<std::uint8_t> beginning(4096);
  file.read(reinterpret_cast<char*>(beginning.data()), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  if (looks_like_sh(beginning)) return true;
  if (is_plain_text(beginning))
    throw Error(command.in.input,
                "is text that does not say what its numbers are; a list of 27 numbers needs --form-in");
  return false;
}

ShDocument load_coefficients(const ShCommand& command) {
  if (!command.in.mapping.empty() || command.lights.wanted() || command.fitted_lights > 0)
    throw CLI::ValidationError("--mapping, --extract-sun, --extract-lights and --fit-lights",
                               "need an environment; " + command.in.input + " is a file of coefficients");
  if (command.faults_given)
    throw CLI::ValidationError("--faults",
                               "is for environments; " + command.in.input + " is a file of coefficients");
  std::optional<ShForm> bare_form;
  if (!command.form_in.empty()) bare_form = parse_sh_form(command.form_in);
  ShDocument document = read_sh_file(command.in.input, bare_form);
  if (document.source.empty()) document.source = source_name(command.in.input);
  try {
    turn(document, command.in.options.rotate_degrees, command.in.options.mirror);
  } catch (const Error& error) {
    throw Error(command.in.input, error.what());
  }
  return document;
}

void add_lights(ShDocument& document, std::span<const DirectionalLight> lights) {
  for (const DirectionalLight& light : lights)
    document.lights.push_back({light.direction, light.irradiance, light.angular_radius});
}

// The environment without the lights that were asked for; they go to the document.
Image take_lights(const Environment& environment, const ShCommand& command, ShDocument& document,
                  std::vector<OutputFile>& files) {
  ExtractedLights extracted = extract_lights(environment.radiance, command.lights.options());
  if (extracted.lights.empty())
    fmt::print(
        stderr,
        "welkin: {}: warning: no light: nothing in it is compact and strong enough (see --light-radius)\n",
        environment.source);
  add_lights(document, extracted.lights);
  if (!command.lights.residual.empty())
    files.push_back({command.lights.residual, encode_flat(command.lights.residual, extracted.residual)});
  return std::move(extracted.residual);
}

ShDocument project(const ShCommand& command, std::vector<OutputFile>& files) {
  const Environment environment = load(command.in);
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", environment.source, warning);
  ShDocument document;
  document.source = source_name(environment.source);
  const int degree = command.degree.value_or(2);
  if (command.fitted_lights > 0) {
    LightFit fit = fit_lights(environment.radiance, command.fitted_lights);
    add_lights(document, fit.lights);
    document.coefficients = std::move(fit.rest);
  } else if (command.lights.wanted()) {
    document.coefficients = project_equirect(take_lights(environment, command, document, files), degree);
  } else {
    document.coefficients = project_equirect(environment.radiance, degree);
  }
  return document;
}

// Of the input's name, whatever of it fails.
template <typename Work>
auto named(const ShCommand& command, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(command.in.input, error.what());
  }
}

// The degree and the quantity that were asked for.
void transform(ShDocument& document, const ShCommand& command) {
  ShCoefficients& coefficients = document.coefficients;
  if (command.degree && *command.degree > coefficients.max_degree)
    throw Error(command.in.input, fmt::format("has degree {}, less than --degree {}", coefficients.max_degree,
                                              *command.degree));
  if (command.degree) coefficients = resize(coefficients, *command.degree);
  named(command, [&] { apply_fit(document, command.fit); });
  if (!command.quantity || *command.quantity == sh_quantity_name(document.quantity)) return;
  const ShQuantity wanted = parse_sh_quantity(*command.quantity);
  named(command,
        [&] { coefficients = sh_of_quantity(sh_radiance_from(coefficients, document.quantity), wanted); });
  document.quantity = wanted;
}

void print_document_lights(const ShDocument& document) {
  if (document.lights.empty()) return;
  fmt::print("lights beside the coefficients: direction, irradiance of a surface that faces it, radius\n");
  for (const ShLight& l : document.lights)
    fmt::print("{:>9.5f} {:>8.5f} {:>8.5f}   {:>11.6g} {:>11.6g} {:>11.6g}   {:.3f} degrees\n", l.direction.x,
               l.direction.y, l.direction.z, l.irradiance[0], l.irradiance[1], l.irradiance[2],
               l.angular_radius * 180 / std::numbers::pi);
}

// Names come out of files; a terminal obeys control characters.
std::string shown(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  return text;
}

void print_table(const ShDocument& document) {
  fmt::print("{} of {}, real orthonormal basis without Condon-Shortley sign, polar axis z\n",
             sh_quantity_name(document.quantity), shown(document.source));
  if (document.window != "none") fmt::print("against ringing: {}\n", shown(document.window));
  fmt::print("{:>3} {:>4} {:>14} {:>14} {:>14}\n", "l", "m", "red", "green", "blue");
  for (int l = 0; l <= document.coefficients.max_degree; ++l)
    for (int m = -l; m <= l; ++m) {
      const double* c = &document.coefficients.values[sh_index(l, m) * 3];
      fmt::print("{:>3} {:>4} {:>14.7g} {:>14.7g} {:>14.7g}\n", l, m, c[0], c[1], c[2]);
    }
  print_document_lights(document);
}

// Numbers near the ends of double leave it on the way.
void check_finite(const ShDocument& document, const ShCommand& command) {
  const auto& values = document.coefficients.values;
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    throw Error(command.in.input, "has coefficients too large or too small to work with; scale them");
}

// The form that was asked for; "" for the table.
std::string form_text(const ShDocument& document, const ShCommand& command) {
  if (!command.json_path.empty()) return named(command, [&] { return write_sh(document, ShForm::json); });
  if (command.form.empty()) return "";
  const ShForm form = parse_sh_form(command.form);
  if (form != ShForm::json && document.coefficients.max_degree > 2)
    throw Error(command.in.input,
                fmt::format("has degree {}, and --form {} holds degree 2; --degree 2 drops the rest",
                            document.coefficients.max_degree, command.form));
  return named(command, [&] { return write_sh(document, form); });
}

// All files or none, and only when everything is made.
void write(const ShDocument& document, const ShCommand& command, std::vector<OutputFile> files) {
  const std::string text = form_text(document, command);
  const std::string& path = command.json_path.empty() ? command.output : command.json_path;
  if (!path.empty()) files.push_back({path, {text.begin(), text.end()}});
  write_files(files);
  if (!path.empty()) return;
  if (command.form.empty()) return print_table(document);
  fmt::print("{}", text);
}

void run(const ShCommand& command) {
  check_usage(command);
  check_residual(command.lights, "the input", command.in.input);
  check_residual(command.lights, "the output", command.output);
  check_residual(command.lights, "the output", command.json_path);
  for (const std::string& path : {command.output, command.json_path, command.lights.residual})
    check_output(path, command.in.input);
  std::vector<OutputFile> files;
  ShDocument document = is_coefficient_file(command) ? load_coefficients(command) : project(command, files);
  transform(document, command);
  check_finite(document, command);
  write(document, command, std::move(files));
}

void add_sh_options(CLI::App& sub, ShCommand& command) {
  add_light_options(sub, command.lights);
  sub.add_option(
         "--fit-lights", command.fitted_lights,
         "The best so many lights beside nine coefficients, for diffuse light alone: they need not be "
         "where the map has sources")
      ->check(CLI::Range(1, 8))
      ->excludes("--extract-sun")
      ->excludes("--extract-lights");
  add_fit_options(sub, command.fit);
  sub.add_option("--degree", command.degree,
                 "Largest degree l: (degree + 1)^2 coefficients; 2 for an environment")
      ->check(CLI::Range(0, max_projection_degree));
  sub.add_option("--quantity", command.quantity,
                 "radiance (for an environment), irradiance or irradiance-over-pi")
      ->check(CLI::IsMember({"radiance", "irradiance", "irradiance-over-pi"}));
  sub.add_option(
         "--form", command.form,
         "Write what an engine reads in place of the table: three, babylon, filament, unity, unreal, godot, "
         "c, glsl, hlsl, json (see docs/conventions.md)")
      ->check(CLI::IsMember(form_names()));
  sub.add_option("-o,--output", command.output, "Where the form goes; standard output unless given")
      ->check(must_be_a_name);
  sub.add_option(
         "--form-in", command.form_in,
         "What the numbers of INPUT are, where it does not say so itself: a bare list of 27 numbers, or the "
         "JSON of three or babylon")
      ->check(CLI::IsMember(form_names()));
  CLI::Option* json = sub.add_option("--json", command.json_path, "The same as --form json -o FILE");
  json->check(must_be_a_name)->excludes("--form")->excludes("--output");
}

}  // namespace

void add_sh_command(CLI::App& app) {
  auto command = std::make_shared<ShCommand>();
  CLI::App* sub = app.add_subcommand(
      "sh", "Spherical-harmonic coefficients of an environment, or of a coefficient file, for engines");
  add_environment_options(*sub, command->in);
  add_sh_options(*sub, *command);
  sub->footer(
      "INPUT can also be a file of coefficients: sh.json or any form that --form writes.\n"
      "Examples:\n  welkin sh park.hdr --form unity -o WelkinSh.cs\n"
      "  welkin sh park.hdr --extract-sun --form three -o probe.json\n"
      "  welkin sh studio.hdr --fit nonnegative --quantity irradiance --json sh.json");
  sub->callback([command, sub] {
    check_light_options(command->lights, *sub);
    check_fit_options(command->fit, *sub);
    command->faults_given = sub->count("--faults") > 0;
    run(*command);
  });
}

}  // namespace welkin
