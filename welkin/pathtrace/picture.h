#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/pathtrace/integrator.h>

// Many samples of many pixels: tiles on all cores, to a number of samples or to an error, stopped and resumed. The sums
// depend on nothing but scene, camera and options: neither on threads nor on where a run was stopped.

namespace welkin {

/// Samples of a pixel go in turn to this many sequences that are scrambled independently of each other. Points of one
/// Owen-scrambled sequence repel each other, so that s^2/n of them overstates the error; the means of the sequences are
/// independent, and their spread is an honest error of the pixel with picture_replicates - 1 degrees of freedom.
inline constexpr int picture_replicates = 8;

struct PictureOptions {
  PictureSize size{512, 512};
  std::uint32_t samples = 64;  ///< per pixel; with target_error the most that a pixel gets
  /// > 0: adaptive. Samples are added until the standard error of a pixel's luminance is at most target_error times its
  /// reference: the luminance about it (mean of 5 x 5 pixels) or the picture's log-average, whichever is greater.
  double target_error = 0;
  std::uint32_t least_samples =
      64;  ///< adaptive: what every pixel gets, however quiet it looks; >= 2 replicates
  IntegratorOptions integrator;
};

/// The sums of all samples so far: what a checkpoint stores and what every output is made of. Three values a pixel are
/// interleaved; rows from the top.
struct PictureState {
  PictureSize size;
  std::vector<std::uint32_t> count;  ///< samples of a pixel
  std::vector<std::uint32_t> goal;   ///< what the round under way brings it to, >= count
  std::vector<double> radiance_sum;
  std::vector<float> replicate_sum;  ///< picture_replicates x 3 a pixel; of radiance
  std::vector<float> albedo_sum, normal_sum;
  std::vector<float> depth_sum;     ///< over samples that met a surface
  std::vector<float> coverage_sum;  ///< how many did
  std::uint64_t faults = 0;         ///< samples that were NaN or infinite and were taken as black
};

/// A state without samples. Throws Error for sizes below 1 or above 16384, or more than 2^26 pixels.
PictureState make_picture_state(PictureSize size);

/// How far a picture is; `share` of the samples that the options ask for at most, or of the way to the error.
struct PictureProgress {
  double share = 0;
  std::uint64_t samples = 0;  ///< of all pixels
};

/// Asked between groups of tiles, several times a second, on the caller's thread: false stops.
using PictureObserver = std::function<bool(const PictureProgress&)>;

/// Adds samples until the options are met (true) or the observer stops it (false). Can go on with any state that the
/// same scene, camera and options gave, and with that of fewer samples where target_error is 0 (the same bytes if those
/// were a multiple of 16, what is traced together; else the same but for rounding).
bool render_picture(PictureState& state, const RenderScene& scene, const Camera& camera,
                    const PictureOptions& options, const PictureObserver& observer = {});

/// The same for any function of a pixel: sample(x, y, replicate, index) gives a PixelSample; the same one for the same
/// arguments, on any thread, and independent ones for other pixels and replicates. picture_loop.h has the definition.
template <class Sample>
bool sample_picture(PictureState& state, const PictureOptions& options, const Sample& sample,
                    const PictureObserver& observer = {});

/// The layers of a picture, each width x height.
struct PictureLayers {
  Image radiance;        ///< 3 channels
  Image standard_error;  ///< 3 channels: of the mean in `radiance`
  Image albedo;          ///< 3, mean over all samples
  Image normal;          ///< 3, world; mean over all samples, so shorter than 1 at edges
  Image depth;           ///< 1, metres along the view axis; mean over the samples that met a surface
  Image coverage;        ///< 1
  Image samples;         ///< 1: how many each pixel got
};

PictureLayers make_picture_layers(const PictureState& state);
/// `radiance` alone, cheaper: for what is watched.
Image picture_radiance(const PictureState& state);

/// The square of the standard error of a pixel's luminance, from the spread of its replicates' means; 0 where fewer than
/// two have samples.
double luminance_variance(const PictureState& state, std::size_t pixel);

/// What a picture reached.
struct PictureError {
  double mean_samples = 0;          ///< per pixel
  double mean_standard_error = 0;   ///< root mean square over pixels of the luminance's
  double mean_relative_error = 0;   ///< root mean square over pixels, relative to the reference above
  double worst_relative_error = 0;  ///< after a mean of the variance over 5 x 5 pixels
  double share_reached = 0;         ///< pixels whose relative error, after that mean, is below target_error
};
PictureError picture_error(const PictureState& state, double target_error = 0);

/// Sets the goals of the next round in `state`, whose goals are all met. False: nothing is left to do.
bool plan_round(PictureState& state, const PictureOptions& options);

}  // namespace welkin
