#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include <welkin/envmap/lights.h>

namespace welkin {

/// The options of every command that can take the sun and other strong sources out of its environment.
struct LightInput {
  bool sun = false;
  int lights = 0;  ///< 0: not asked for
  double max_angular_radius = LightOptions{}.max_angular_radius;
  std::string residual;

  bool wanted() const { return sun || lights > 0; }
  LightOptions options() const {
    LightOptions o;
    o.max_lights = lights > 0 ? lights : 1;
    o.max_angular_radius = max_angular_radius;
    return o;
  }
};

void add_light_options(CLI::App& sub, LightInput& in);

/// Throws Error when --residual is `other` ("the input", "-o") of that path: one would overwrite the other.
void check_residual(const LightInput& in, const std::string& other, const std::string& path);

/// Throws CLI::ValidationError for options that mean nothing without the lights, Error for a bad --residual.
void check_light_options(const LightInput& in, const CLI::App& sub);

}  // namespace welkin
