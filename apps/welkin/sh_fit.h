#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include <welkin/sh/forms/document.h>

namespace welkin {

/// What is done to coefficients before they are written.
struct ShFitOptions {
  std::string name = "plain";  ///< plain, nonnegative, zh3, zh3-nonnegative, hann, lanczos, laplacian
  double width = 3;            ///< of the windows hann and lanczos
};

void add_fit_options(CLI::App& sub, ShFitOptions& options);

/// Whether the fit takes other degrees than 2 and below.
bool fits_any_degree(const ShFitOptions& options);

/// Throws CLI::ValidationError for a width that no window takes.
void check_fit_options(const ShFitOptions& options, const CLI::App& sub);

/// Applies the fit, to the irradiance whatever the quantity, and names it in document.window. Throws Error for degrees
/// that the fit does not take.
void apply_fit(ShDocument& document, const ShFitOptions& options);

/// The document turned about +Y and mirrored as environments are (welkin/envmap/environment.h), lights included.
void turn(ShDocument& document, double rotate_degrees, bool mirror);

}  // namespace welkin
