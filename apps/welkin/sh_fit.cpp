#include "sh_fit.h"

#include <fmt/format.h>

#include "environment_options.h"

#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/window.h>
#include <welkin/sh/zh3.h>
#include <welkin/sphere/orientation.h>

namespace welkin {
namespace {

bool is_window(const std::string& name) { return name == "hann" || name == "lanczos"; }

ShCoefficients windowed(const ShCoefficients& c, const ShFitOptions& options) {
  return convolve(c, options.name == "hann" ? hann_window(options.width, c.max_degree)
                                            : lanczos_window(options.width, c.max_degree));
}

// Of the irradiance.
ShCoefficients least_blurred(const ShCoefficients& irradiance, std::string& says) {
  const std::vector<double> lambdas = weakest_laplacian(irradiance, WindowScope::all_channels);
  says = fmt::format("laplacian, lambda {:.9g}, the weakest without negative irradiance", lambdas.at(0));
  return laplacian_windowed(irradiance, lambdas);
}

ShCoefficients zonal_fit(const ShCoefficients& irradiance, bool nonnegative, std::string& says) {
  Zh3 fit = fit_zh3(irradiance, zh3_best_axis(irradiance));
  if (nonnegative) fit = nonnegative_zh3(fit);
  says = fmt::format("ZH3 about ({:.9g}, {:.9g}, {:.9g}){}", fit.axis.x, fit.axis.y, fit.axis.z,
                     nonnegative ? ", irradiance non-negative" : "");
  return zh3_to_sh(fit);
}

// Nine digits are what files keep, so the proof is of the rounded numbers, where they are irradiance.
ShCoefficients without_negatives(const ShCoefficients& irradiance, std::string& says) {
  std::vector<NonnegativeFit> fits;
  ShCoefficients fitted = nonnegative_fit(irradiance, CoefficientRounding::to_digits9, &fits);
  says = "non-negative fit of the irradiance, multipliers";
  for (const NonnegativeFit& fit : fits) says += fmt::format(" {:.17g}", fit.multiplier);
  return fitted;
}

}  // namespace

void add_fit_options(CLI::App& sub, ShFitOptions& options) {
  sub.add_option("--fit", options.name,
                 "Against negative irradiance: nonnegative (the nearest that is nowhere below 0), "
                 "zh3 and zh3-nonnegative (15 numbers), or the windows hann, lanczos, laplacian (they blur)")
      ->check(
          CLI::IsMember({"plain", "nonnegative", "zh3", "zh3-nonnegative", "hann", "lanczos", "laplacian"}))
      ->capture_default_str();
  sub.add_option("--window-width", options.width, "Degree at which hann and lanczos end")
      ->check(must_be_finite)
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
}

bool fits_any_degree(const ShFitOptions& options) {
  return options.name == "plain" || is_window(options.name);
}

void check_fit_options(const ShFitOptions& options, const CLI::App& sub) {
  if (sub.count("--window-width") > 0 && !is_window(options.name))
    throw CLI::ValidationError("--window-width", "is for --fit hann and --fit lanczos");
}

void apply_fit(ShDocument& document, const ShFitOptions& options) {
  if (options.name == "plain") return;
  if (is_window(options.name)) {
    document.coefficients = windowed(document.coefficients, options);
    document.window = fmt::format("{}, width {:.9g}", options.name, options.width);
    return;
  }
  if (document.coefficients.max_degree > 2)
    throw Error(fmt::format("--fit {} is for degree 2", options.name));
  const ShQuantity quantity = document.quantity;
  const ShCoefficients irradiance =
      sh_of_quantity(sh_radiance_from(document.coefficients, quantity), ShQuantity::irradiance);
  ShCoefficients fitted;
  if (options.name == "laplacian")
    fitted = least_blurred(irradiance, document.window);
  else if (options.name == "nonnegative")
    fitted = without_negatives(irradiance, document.window);
  else
    fitted = zonal_fit(irradiance, options.name == "zh3-nonnegative", document.window);
  document.coefficients = quantity == ShQuantity::irradiance
                              ? fitted
                              : sh_of_quantity(sh_radiance_from(fitted, ShQuantity::irradiance), quantity);
}

void turn(ShDocument& document, double rotate_degrees, bool mirrored) {
  const auto move = [&](const Mat3& m) {
    for (ShLight& light : document.lights) light.direction = m * light.direction;
  };
  if (mirrored) {
    document.coefficients = mirror(document.coefficients, MirrorAxis::z);
    move(mirror_matrix());
  }
  if (rotate_degrees != 0) {
    document.coefficients = rotate(document.coefficients, rotation_about_y(rotate_degrees));
    move(rotation_about_y(rotate_degrees));
  }
}

}  // namespace welkin
