#include "light_options.h"

#include <filesystem>

#include "environment_options.h"
#include "flat_file.h"

#include <welkin/error.h>

namespace welkin {

void add_light_options(CLI::App& sub, LightInput& in) {
  CLI::Option* sun =
      sub.add_flag("--extract-sun", in.sun, "Take the strongest compact source out, as a directional light");
  sub.add_option("--extract-lights", in.lights,
                 "The same for up to so many sources (windows, lamps, the sun and its glow)")
      ->check(CLI::Range(1, 64))
      ->excludes(sun);
  sub.add_option("--light-radius", in.max_angular_radius,
                 "Largest angular radius of a source, in degrees; what is larger stays in the map")
      ->check(must_be_finite)
      ->check(CLI::Range(0.05, 45.0))
      ->capture_default_str();
  sub.add_option("--residual", in.residual,
                 "Write the map without the lights, filled from around: .hdr, .exr or .png (tone-mapped)")
      ->check(must_be_a_name);
}

void check_residual(const LightInput& in, const std::string& other, const std::string& path) {
  if (in.residual.empty() || path.empty()) return;
  std::error_code none;
  const auto plain = [](const std::string& p) { return std::filesystem::absolute(p).lexically_normal(); };
  if (plain(in.residual) == plain(path) || std::filesystem::equivalent(in.residual, path, none))
    throw Error(in.residual, "is " + other + " too; choose another name for --residual");
}

void check_light_options(const LightInput& in, const CLI::App& sub) {
  if (!in.residual.empty()) check_flat_name(in.residual);
  if (in.wanted()) return;
  for (const char* name : {"--light-radius", "--residual"})
    if (sub.count(name) > 0)
      throw CLI::ValidationError(name, "means nothing without --extract-sun or --extract-lights N");
}

}  // namespace welkin
