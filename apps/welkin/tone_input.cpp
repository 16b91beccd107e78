#include "tone_input.h"

#include <charconv>
#include <cmath>

namespace welkin {

void add_tone_options(CLI::App& sub, std::string& exposure, std::string& curve) {
  sub.add_option("--exposure", exposure, "PNG: stops, or auto")->capture_default_str();
  sub.add_option("--curve", curve, "PNG: filmic, srgb (clipped) or reinhard")
      ->check(CLI::IsMember({"filmic", "srgb", "reinhard"}))
      ->capture_default_str();
}

ToneMapOptions parse_tone(const std::string& exposure, const std::string& curve) {
  ToneMapOptions options;
  options.curve = curve == "filmic"     ? ToneCurve::filmic
                  : curve == "reinhard" ? ToneCurve::reinhard
                                        : ToneCurve::clamp;
  if (exposure == "auto") return options;
  double stops = 0;
  const char *begin = exposure.data(), *end = begin + exposure.size();
  const auto [rest, error] = std::from_chars(begin, end, stops);
  if (error != std::errc() || rest != end || !(std::abs(stops) <= 100))
    throw CLI::ValidationError("--exposure",
                               "is auto or a number of stops from -100 to 100, not '" + exposure + "'");
  options.exposure_ev = stops;
  return options;
}

}  // namespace welkin
