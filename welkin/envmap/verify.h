#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include <welkin/envmap/ibl.h>

namespace welkin {

struct VerifyOptions {
  int directions =
      64;  ///< per level and test, drawn at random besides the brightest texel and its surroundings
  std::uint32_t seed = 1;
  std::function<void(double)> progress{};  ///< told the share done, in [0, 1], from the calling thread
};

/// Errors against filter_brute_force. mean is the level's mean luminance over the sphere.
struct LevelErrors {
  double relative_rms =
      0;  ///< at texel centres: RMS of the error over RMS of the truth, uniform over the texels
  double max_over_mean = 0;  ///< at texel centres: largest error of a channel over the mean
  double energy = 0;  ///< integral of the level (see cube_energy) over that of the map, minus 1 (luminance)
  double edge_step =
      0;  ///< step across the 12 edges over the step predicted there, see edge_step_ratio; 0: not measured
  double lookup_relative_rms = 0;  ///< seamless bilinear look-up in this level in random directions
  double lookup_max_over_mean = 0;
};

struct IblErrors {
  std::vector<LevelErrors> levels;    ///< of the specular map; level 0 is compared with the map itself
  double trilinear_relative_rms = 0;  ///< specular look-up at random directions and roughness, levels blended
  double trilinear_max_over_mean = 0;
  std::vector<double> trilinear_by_roughness;  ///< relative RMS in ten equal bands of perceptual_roughness
  LevelErrors irradiance;                      ///< of the irradiance map (energy: against pi times the map's)
  double sh_mean = 0,
         sh_max =
             0;  ///< irradiance from nine coefficients: mean and largest error over the largest irradiance
  double dfg_max =
      0;  ///< largest difference of the table from a mean over visible normals, itself good to 3e-5
  int directions = 0;  ///< how many truths were computed in all
  double seconds = 0;
};

/// Measures every output of make_ibl, before it is rounded to a file format, against the oracle. radiance and options are those the set was made from.
IblErrors verify_ibl(const IblSet& set, const Image& radiance, const IblOptions& options,
                     const VerifyOptions& verify = {});

}  // namespace welkin
