#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/image/faults.h>
#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>
#include <welkin/sphere/mapping.h>

namespace welkin {

struct EnvironmentOptions {
  /// What a flat image shows; unset: told from its proportions (2:1 equirectangular, 4:3, 3:4, 6:1, 1:6 cube layouts).
  std::optional<Mapping> mapping;
  /// Degrees that the environment is turned about +Y, right-handed: at 90 what was at +X comes to -Z (in an
  /// equirectangular map everything moves left by a quarter).
  double rotate_degrees = 0;
  /// The equirectangular picture flipped left to right (z -> -z), before the rotation.
  bool mirror = false;
  FaultPolicy faults = FaultPolicy::repair;
};

/// An environment ready for every algorithm of this module.
struct Environment {
  Image radiance;                   ///< equirectangular, 3 channels, linear Rec. 709, finite and >= 0
  std::string source;               ///< the file or sky that it came from
  std::string description;          ///< "equirectangular 1024 x 512, Radiance HDR"
  PixelFaults faults;               ///< values that were repaired
  float smallest = 0, largest = 0;  ///< of any channel of the input itself, repaired, before any resampling
  std::vector<std::string> warnings;
};

/// Loads a file (see load_image) or makes a sky ("sky:..." as parse_sky reads it), as an equirectangular map: cubes and
/// the other mappings are resampled. Throws Error naming the input when it cannot be read, when its proportions fit no
/// mapping and none was given, when it has faults and they are refused, when it is black all over, when it
/// holds values above 1e30, and when the rotation is not finite.
Environment load_environment(std::string_view input, const EnvironmentOptions& options = {});

/// The same from a picture in memory; `name` is for messages and becomes `source`.
Environment make_environment(LoadedImage loaded, std::string_view name,
                             const EnvironmentOptions& options = {});

}  // namespace welkin
