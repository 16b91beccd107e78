#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "commands.h"
#include "environment_options.h"
#include "sh_json.h"
#include "source_name.h"

#include <welkin/image/output_file.h>

// welkin sh: spherical-harmonic coefficients of an environment, with their conventions named.

namespace welkin {
namespace {

struct ShCommand {
  EnvironmentInput in;
  int degree = 2;
  std::string quantity = "radiance";
  std::string json_path;
};

void print_table(const ShCoefficients& coefficients) {
  fmt::print("{:>3} {:>4} {:>14} {:>14} {:>14}\n", "l", "m", "red", "green", "blue");
  for (int l = 0; l <= coefficients.max_degree; ++l)
    for (int m = -l; m <= l; ++m) {
      const double* c = &coefficients.values[sh_index(l, m) * 3];
      fmt::print("{:>3} {:>4} {:>14.7g} {:>14.7g} {:>14.7g}\n", l, m, c[0], c[1], c[2]);
    }
}

void run(const ShCommand& command) {
  const Environment environment = load(command.in);
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", environment.source, warning);
  const ShQuantity quantity = parse_sh_quantity(command.quantity);
  const ShCoefficients coefficients =
      sh_of_quantity(project_equirect(environment.radiance, command.degree), quantity);
  if (command.json_path.empty()) {
    fmt::print("{} of {}, real orthonormal basis without Condon-Shortley sign, polar axis z\n",
               command.quantity, environment.source);
    print_table(coefficients);
    return;
  }
  write_file(command.json_path,
             sh_json_text(sh_to_json(coefficients, quantity, source_name(environment.source))));
}

}  // namespace

void add_sh_command(CLI::App& app) {
  auto command = std::make_shared<ShCommand>();
  CLI::App* sub = app.add_subcommand("sh", "Spherical-harmonic coefficients of an environment");
  add_environment_options(*sub, command->in);
  sub->add_option("--degree", command->degree, "Largest degree l: (degree + 1)^2 coefficients")
      ->check(CLI::Range(0, max_projection_degree))
      ->capture_default_str();
  sub->add_option("--quantity", command->quantity, "radiance, irradiance or irradiance-over-pi")
      ->check(CLI::IsMember({"radiance", "irradiance", "irradiance-over-pi"}))
      ->capture_default_str();
  sub->add_option("--json", command->json_path, "Write a JSON file in place of the table");
  sub->footer("Example: welkin sh park.hdr --degree 2 --quantity irradiance --json sh.json");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
