#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <welkin/brdf/brdf_spec.h>
#include <welkin/brdf/lobe_fit.h>
#include <welkin/brdf/merl.h>
#include <welkin/brdf/scatter/scatter_spec.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>

#include "brdf_sampling.h"
#include "commands.h"
#include "flat_file.h"
#include "json_text.h"

// welkin brdf: what a BRDF is in numbers, and as a file in the layout of the MERL database.

namespace welkin {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct BrdfCommand {
  std::string spec, output;
  int lobes = 1;
  bool json = false, sampling = false;
  int samples = 1 << 18;
};

double largest_of(const std::array<double, 3>& rgb) { return *std::max_element(rgb.begin(), rgb.end()); }

struct BrdfFacts {
  double greatest = 0;     // of a channel, at cosines from 0.05 up
  double reciprocity = 0;  // largest |f(l, v) - f(v, l)| over the larger of the two
};

// Random pairs for reciprocity, and for the greatest value a grid that has every mirror configuration in it.
BrdfFacts measure(const IsotropicBrdf& brdf) {
  BrdfFacts facts;
  constexpr int steps = 39;
  const auto cosine = [](int i) { return 0.05 + 0.95 * i / (steps - 1); };
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j)
      for (int k = 0; k <= 24; ++k)
        facts.greatest =
            std::max(facts.greatest, largest_of(brdf.value(cosine(i), cosine(j), std::numbers::pi * k / 24)));
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
  for (int i = 0; i < 20000; ++i) {
    const double light = 0.02 + 0.98 * uniform(), view = 0.02 + 0.98 * uniform();
    const double azimuth = std::numbers::pi * uniform();
    const auto there = brdf.value(light, view, azimuth), back = brdf.value(view, light, azimuth);
    for (int c = 0; c < 3; ++c) {
      const double larger = std::max(there[c], back[c]);
      if (larger > 1e-6 * facts.greatest)
        facts.reciprocity = std::max(facts.reciprocity, std::abs(there[c] - back[c]) / larger);
    }
  }
  return facts;
}

// The energies of a view's lobes add up to the directional albedo, which the fit has by quadrature.
std::array<double, 3> albedo(const LobeFit& fit) {
  std::array<double, 3> sum{};
  for (const FittedLobe& lobe : fit.lobes)
    for (int c = 0; c < 3; ++c) sum[c] += lobe.energy[c];
  return sum;
}

// The angle at which a shape falls below half of its largest value for good.
double half_width(const FittedLobe& lobe, const std::vector<double>& angles) {
  const double half = *std::max_element(lobe.values.begin(), lobe.values.end()) / 2;
  std::size_t last = 0;
  for (std::size_t i = 0; i < lobe.values.size(); ++i)
    if (lobe.values[i] >= half) last = i;
  return angles[last];
}

std::vector<double> view_angles() {
  std::vector<double> angles;
  for (double cosine : {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05})
    angles.push_back(std::acos(cosine));
  return angles;
}

void print_text(const IsotropicBrdf& brdf, const BrdfFacts& facts, const std::vector<LobeFit>& fits) {
  const std::vector<double> angles = lobe_angles(brdf);
  fmt::print("{}\n", brdf.name);
  fmt::print("  angular width      {:.4g} degrees\n", brdf.angular_width * degrees);
  fmt::print("  greatest value     {:.6g} per sr, cosines from 0.05 up\n", facts.greatest);
  fmt::print("  reciprocity error  {:.2g} of the value\n", facts.reciprocity);
  fmt::print(
      "cos view  angle  directional albedo          fit error  lobes: axis, half width (degrees), energy\n");
  for (const LobeFit& fit : fits) {
    const auto a = albedo(fit);
    fmt::print("{:>8.2f} {:>6.1f}  {:<8.5f} {:<8.5f} {:<8.5f} {:>9.1f} % ", std::cos(fit.view_angle),
               fit.view_angle * degrees, a[0], a[1], a[2], 100 * fit.relative_error);
    for (const FittedLobe& lobe : fit.lobes)
      fmt::print(" {:>6.1f} {:>6.2f} {:.4f} {:.4f} {:.4f}", lobe.axis * degrees,
                 half_width(lobe, angles) * degrees, lobe.energy[0], lobe.energy[1], lobe.energy[2]);
    fmt::print("\n");
  }
}

void print_json(const IsotropicBrdf& brdf, const BrdfFacts& facts, const std::vector<LobeFit>& fits) {
  const std::vector<double> angles = lobe_angles(brdf);
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  for (const LobeFit& fit : fits) {
    nlohmann::ordered_json lobes = nlohmann::ordered_json::array();
    for (const FittedLobe& lobe : fit.lobes)
      lobes.push_back(
          {{"axis", lobe.axis}, {"half_width", half_width(lobe, angles)}, {"energy", lobe.energy}});
    views.push_back({{"cos_view", std::cos(fit.view_angle)},
                     {"angle", fit.view_angle},
                     {"directional_albedo", albedo(fit)},
                     {"fit_error", fit.relative_error},
                     {"lobes", lobes}});
  }
  fmt::print("{}\n", json_text({{"brdf", brdf.name},
                                {"angular_width", brdf.angular_width},
                                {"greatest_value", facts.greatest},
                                {"reciprocity_error", facts.reciprocity},
                                {"views", views}}));
}

void run(const BrdfCommand& command) {
  if (command.sampling) return print_brdf_sampling(command.spec, command.samples, command.json);
  if (!command.output.empty()) {
    if (extension_of(command.output) != ".binary")
      throw Error(command.output, "has an unknown extension; the layout of MERL is .binary");
    const bool measured = command.spec.rfind("merl:", 0) == 0;
    check_output(command.output, measured ? command.spec.substr(5) : "");
  }
  const IsotropicBrdf brdf = parse_brdf(command.spec);
  const std::vector<LobeFit> fits = fit_lobes(brdf, view_angles(), {.lobes = command.lobes});
  const BrdfFacts facts = measure(brdf);
  if (!command.output.empty()) write_file(command.output, encode_merl(tabulate_merl(brdf)));
  command.json ? print_json(brdf, facts, fits) : print_text(brdf, facts, fits);
}

}  // namespace

void add_brdf_command(CLI::App& app) {
  auto command = std::make_shared<BrdfCommand>();
  CLI::App* sub =
      app.add_subcommand("brdf", "Albedo, reciprocity and fitted lobes of a BRDF, or a MERL file of it");
  sub->add_option("SPEC", command->spec, std::string(brdf_choices()))->required();
  sub->add_option("--lobes", command->lobes, "Lobes fitted to each view")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  sub->add_option("-o,--output", command->output,
                  "FILE.binary: the BRDF in the layout of the MERL database, 90 x 90 x 180 cells, 35 MB");
  CLI::Option* sampling = sub->add_flag(
      "--sampling", command->sampling,
      "The BRDF as the path tracer has it: albedo by quadrature and by sampling, noise of a white "
      "furnace, chi-square test of the sampler (p), times. SPEC is then one of: " +
          std::string(scatter_choices()));
  sub->add_option("--samples", command->samples, "Samples a view of --sampling")
      ->check(CLI::Range(1000, 1000000000))
      ->capture_default_str()
      ->needs(sampling);
  sampling->excludes("--lobes")->excludes("--output");
  sub->add_flag("--json", command->json, "Print JSON; angles in radians");
  sub->footer(
      "Examples:\n  welkin brdf ggx:0.25,0.9 --lobes 2\n  welkin brdf ward:0.2 -o ward.binary && "
      "welkin brdf merl:ward.binary\n  welkin brdf ggx:0.1:0.5,1,compensated --sampling");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
