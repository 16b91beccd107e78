#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/sh/forms/form.h>

namespace welkin {

/// A light that was taken out of an environment before its coefficients were made.
struct ShLight {
  Vec3 direction{0, 1, 0};  ///< towards the light, unit length, our axes
  std::array<double, 3>
      irradiance{};           ///< of a surface that faces it, whatever the quantity of the coefficients
  double angular_radius = 0;  ///< rad
};

inline constexpr std::size_t max_sh_lights = 64;

/// Coefficients that say what they are: our basis and axes (basis.h), three channels, linear Rec. 709.
struct ShDocument {
  ShCoefficients coefficients;
  ShQuantity quantity = ShQuantity::radiance;
  std::string source;             ///< what they were made of, e.g. "park.hdr"; any bytes
  std::string window = "none";    ///< what was done against ringing, e.g. "hann, width 3", "non-negative fit"
  std::vector<ShLight> lights{};  ///< beside the coefficients, strongest first; at most max_sh_lights
};

/// Larger files are no coefficient files: degree 128 takes under 1 MB.
inline constexpr std::size_t max_sh_file_size = 4 << 20;

/// The text of a file of that form: UTF-8, nine significant digits, one coefficient a line, the same bytes for the
/// same input. All but json hold degree 2 exactly and say in a comment what they hold, in which axes, and which shader
/// lines use it. Lights stand beside the coefficients, in the form's own axes; only json reads `window` back. Throws
/// Error when `document` has a higher degree (json: never), other than 3 channels, or numbers that are not finite, or too large
/// for the floats of an engine's form.
std::string write_sh(const ShDocument& document, ShForm form);

/// Reads what write_sh writes, recognised by content, and the sh.txt of Filament's cmgen. A bare list of 27 numbers (as
/// text, or as a JSON array) or an engine's JSON without our marker is read as `bare_form`, which must not contradict a
/// file that says what it is. Engine forms come back as radiance of degree 2, json as the quantity that it has.
/// Throws Error naming `name`, in one line, when the text is damaged, cut off, too large, has too few or too many
/// numbers, numbers that are not finite, or another convention.
ShDocument read_sh(std::span<const std::uint8_t> bytes, std::string_view name,
                   std::optional<ShForm> bare_form = {});

/// The same from a file.
ShDocument read_sh_file(const std::filesystem::path& path, std::optional<ShForm> bare_form = {});

/// Whether the beginning of a file looks like coefficients, not like an image.
bool looks_like_sh(std::span<const std::uint8_t> bytes);

}  // namespace welkin
