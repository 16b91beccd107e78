#pragma once
#include <span>
#include <vector>

#include <welkin/sh/projection.h>

// Windows against ringing: factors by degree for convolve(). They blur. For irradiance a non-negative fit is far better
// than any window; windows are here because engines use them and people compare.

namespace welkin {

/// (1 + cos(pi l/width))/2 for l < width, else 0 ("Hanning" in Sloan 2008, Stupid SH Tricks). width > 0, else Error.
std::vector<double> hann_window(double width, int max_degree);

/// sin(pi l/width)/(pi l/width) for l < width, else 0 (Sloan 2008).
std::vector<double> lanczos_window(double width, int max_degree);

/// 1/(1 + lambda l^2 (l+1)^2): the compromise between the function and a small squared Laplacian, which is
/// l(l+1) in frequency space (Sloan 2008, "Windowing"). lambda in [0, infinity]; infinity keeps the mean alone.
std::vector<double> laplacian_window(double lambda, int max_degree);

/// Whose negative values count, and who shares a lambda.
enum class WindowScope {
  each_channel,  ///< every channel has the weakest that it needs: colours of the mean are kept, hues may change
  all_channels,  ///< one for all, the weakest that makes every channel non-negative
  luminance      ///< one for all, the weakest for 0.2126 R + 0.7152 G + 0.0722 B; a channel may stay negative
};

/// The smallest lambda, one per channel, with which the windowed function is nowhere negative, to 1e-12 of its mean: 0
/// where it is not negative anyway, infinity where the mean is 0 and the function is not. It is a true smallest: each
/// step goes to the first lambda at which the worst direction is lit, and no smaller one can do. The minimum is exact to
/// degree 2 (minimum_degree2) and find_minimum's above. Throws Error when the coefficients are malformed or of a degree
/// above max_minimum_search_degree, a mean is negative, or luminance is asked of other than 3 channels.
std::vector<double> weakest_laplacian(const ShCoefficients& coefficients, WindowScope scope);

/// Every channel under its own Laplacian window; lambdas.size() = channels, else Error.
ShCoefficients laplacian_windowed(const ShCoefficients& coefficients, std::span<const double> lambdas);

}  // namespace welkin
