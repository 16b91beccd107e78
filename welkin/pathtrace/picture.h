#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/pathtrace/integrator.h>

// Many samples of many pixels: tiles on all cores, adaptive, stopped and resumed.

namespace welkin {

struct PictureOptions {
  PictureSize size{512, 512};
  std::uint32_t samples = 64;  ///< per pixel; with target_error the most that a pixel gets
  double target_error = 0;  ///< > 0: adaptive; standard error of a pixel's luminance over the picture's mean
  IntegratorOptions integrator;
};

/// The sums of all samples so far: what a checkpoint stores and what every output is made of. All per pixel, in double.
struct PictureState {
  PictureSize size;
  std::vector<std::uint32_t> count;
  std::vector<double> radiance_sum, radiance_square_sum;  ///< 3 a pixel
  std::vector<double> albedo_sum, normal_sum;             ///< 3 a pixel
  std::vector<double> depth_sum, coverage_sum;
};

/// The layers of a picture, each width x height.
struct PictureLayers {
  Image radiance;        ///< 3 channels
  Image standard_error;  ///< 3 channels: of the mean in `radiance`
  Image albedo;          ///< 3
  Image normal;          ///< 3, world
  Image depth;           ///< 1
  Image coverage;        ///< 1
  Image samples;         ///< 1: how many each pixel got
};

}  // namespace welkin
