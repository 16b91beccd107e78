#pragma once
#include <optional>

#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>

namespace welkin {

enum class ToneCurve {
  clamp,     ///< nothing but exposure: what is above 1 is white
  reinhard,  ///< compresses luminance (Reinhard et al. 2002, eq. 4), keeps hue until a channel clips
  filmic,  ///< each channel by the S-curve that Narkowicz (2015, "ACES filmic tone mapping curve") fitted to ACES
};

struct ToneMapOptions {
  /// Stops: pixels are multiplied by 2^ev. Unset: the log-average luminance is brought to 0.18 (Reinhard et
  /// al. 2002, eq. 1 and 2).
  std::optional<double> exposure_ev;
  ToneCurve curve = ToneCurve::reinhard;
  /// The exposed luminance that the reinhard curve maps to 1; > 0.
  double white = 16;
};

/// The exposure that tone_map chooses by itself, in stops: log2(0.18 / log-average luminance), where only
/// pixels with a finite positive luminance count. 0 for an image that has none, 3 channels or 1.
double automatic_exposure_ev(const Image& image);

/// Linear Rec.709 (3 channels) or gray (1) to 8-bit sRGB with as many channels, for looking at. NaN and
/// negative values become black, infinity white.
ByteImage tone_map(const Image& image, const ToneMapOptions& options = {});

}  // namespace welkin
