#pragma once
#include <cstddef>
#include <optional>

#include <welkin/image/image.h>

namespace welkin {

/// A picture that says how far it may be off.
struct MeasuredImage {
  const Image* mean = nullptr;
  const Image* standard_error = nullptr;  ///< as large, as many channels; nullptr: exact
  /// Of the standard errors; nothing: they are known exactly.
  std::optional<double> degrees_of_freedom;
};

/// Whether two pictures differ by more than their errors. Every value of both pictures has its score: the difference over
/// its standard error, carried from Student's distribution (degrees of freedom after Welch 1947, Satterthwaite 1946) to
/// the normal one by equal probability (Wallace 1959). Under the hypothesis that both have the same mean, scores are
/// standard normal as far as pixel means are; a renderer's are only with samples enough.
struct ZTest {
  std::size_t count = 0;  ///< scores
  std::size_t exact = 0;  ///< values without an error and equal: no scores
  std::size_t faults =
      0;  ///< values that are not finite, or without an error and unequal: no scores, never equal
  double share_beyond_2 = 0, share_beyond_3 = 0;  ///< of the scores; 0.0455 and 0.0027 are expected
  double mean_square = 0;                         ///< of the scores: 1
  /// Of the mean over pixels of the scores' mean square, told from how that spreads over pixels, so that channels which
  /// go together and wide tails count as what they are: standard normal for many pixels.
  double mean_square_score = 0;
  double mean_score =
      0;  ///< the same for the mean of the scores: large where one picture is darker as a whole
  double worst_score = 0;
  int worst_x = 0, worst_y = 0, worst_channel = 0;
  /// The probability of a score as far out as the worst among as many independent ones (Sidak 1967), both sides.
  double worst_probability = 1;
  /// No faults, and worst_probability and the two-sided probability of mean_score both above significance / 2.
  bool equal = true;
};

inline constexpr double share_expected_beyond_2 = 0.0455002639, share_expected_beyond_3 = 0.0026997961;

/// Sizes and channels are equal by the caller's duty. `significance`: how often equal pictures may be called unequal.
ZTest z_test(const MeasuredImage& a, const MeasuredImage& b, double significance = 0.01);

/// The score of a value t with Student's distribution: standard normal, the same sign. Off by less than 0.016 for 7 degrees of
/// freedom and more, up to |t| = 6 (tested).
double normal_score(double t, double degrees_of_freedom);

}  // namespace welkin
