#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

#include <welkin/envmap/environment.h>

namespace welkin {

/// Names of mappings that mapping_from_name knows, as a check of an option.
inline CLI::IsMember is_mapping() {
  return CLI::IsMember({"equirectangular", "equirect", "latlong", "cube", "dual-paraboloid", "paraboloid",
                        "mirror-ball", "sphere-map", "octahedral", "octa"});
}

/// A check that refuses NaN and infinity, which are numbers to the parser.
inline std::string must_be_finite(const std::string& text) {
  return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : text + " is not a finite number";
}

/// A check that refuses the empty name, which a script's unset variable leaves behind.
inline std::string must_be_a_name(const std::string& text) {
  return text.empty() ? "needs the name of a file, and got an empty one" : "";
}

/// The input and the options that every command which reads an environment has in common.
struct EnvironmentInput {
  std::string input;
  std::string mapping;
  std::string faults = "repair";
  EnvironmentOptions options;
};

inline void add_environment_options(CLI::App& sub, EnvironmentInput& in) {
  sub.add_option("INPUT", in.input,
                 "An HDR file (.hdr .exr .ktx2 .dds .png .jpg) or sky:... (see welkin sky --help)")
      ->required();
  sub.add_option("--mapping", in.mapping,
                 "What a flat image shows: equirectangular, cube, dual-paraboloid, mirror-ball, octahedral")
      ->check(is_mapping());
  sub.add_option("--rotate", in.options.rotate_degrees, "Turn the environment about +Y by so many degrees")
      ->check(must_be_finite);
  sub.add_flag("--mirror", in.options.mirror, "Swap left and right");
  sub.add_option("--faults", in.faults, "NaN, infinite and negative values: repair or refuse")
      ->check(CLI::IsMember({"repair", "refuse"}))
      ->capture_default_str();
}

inline Environment load(const EnvironmentInput& in) {
  EnvironmentOptions options = in.options;
  options.faults = in.faults == "refuse" ? FaultPolicy::refuse : FaultPolicy::repair;
  if (!in.mapping.empty()) options.mapping = mapping_from_name(in.mapping);
  return load_environment(in.input, options);
}

}  // namespace welkin
