#include "compare_pictures.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include <welkin/error.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/output_file.h>
#include <welkin/image/srgb.h>
#include <welkin/image/tonemap.h>

namespace welkin {
namespace {

struct ErrorLayer {
  Image standard_error;
  std::optional<double> degrees_of_freedom;
};

std::optional<ErrorLayer> error_layer(const std::string& name, const LoadedImage& image) {
  if (image.format.rfind("OpenEXR", 0) != 0) return std::nullopt;
  constexpr std::array<std::string_view, 3> rgb{"R", "G", "B"};
  const ExrLayers layers = decode_exr_layers(read_file(name), name);
  const ExrLayer* found = find_layer(layers, "stderr", rgb);
  if (!found) return std::nullopt;
  if (found->image.width != image.flat.width || found->image.height != image.flat.height)
    throw Error(name, "has a standard error for its data window only; crop it to its display window first");
  return ErrorLayer{found->image, layers.error_degrees_of_freedom};
}

MeasuredImage measured(const LoadedImage& image, const std::optional<ErrorLayer>& error) {
  if (!error) return {&image.flat, nullptr, std::nullopt};
  return {&image.flat, &error->standard_error, error->degrees_of_freedom};
}

bool is_shown_as_it_is(const LoadedImage& image) {
  return image.format.rfind("PNG", 0) == 0 || image.format.rfind("JPEG", 0) == 0;
}

ByteImage shown(const LoadedImage& image, double exposure_ev) {
  ToneMapOptions options;
  options.curve = is_shown_as_it_is(image) ? ToneCurve::clamp : ToneCurve::filmic;
  options.exposure_ev = is_shown_as_it_is(image) ? 0 : exposure_ev;
  return tone_map(image.flat, options);
}

Image linear(const ByteImage& bytes) {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(srgb_to_linear(i / 255.0));
  Image image(bytes.width, bytes.height, bytes.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = table[bytes.pixels[i]];
  return image;
}

}  // namespace

ZTest z_test_of_files(const std::string& a, const std::string& b, const LoadedImage& image_a,
                      const LoadedImage& image_b) {
  const auto error_a = error_layer(a, image_a), error_b = error_layer(b, image_b);
  if (!error_a && !error_b)
    throw Error(a, "has no layer stderr (R, G, B), and neither has " + b + "; welkin render writes it");
  return z_test(measured(image_a, error_a), measured(image_b, error_b));
}

nlohmann::ordered_json z_test_json(const ZTest& t) {
  return {
      {"scores", t.count},
      {"exact", t.exact},
      {"faults", t.faults},
      {"share_beyond_2", t.share_beyond_2},
      {"share_beyond_3", t.share_beyond_3},
      {"mean_square", t.mean_square},
      {"mean_square_score", t.mean_square_score},
      {"mean_score", t.mean_score},
      {"worst", {{"score", t.worst_score}, {"x", t.worst_x}, {"y", t.worst_y}, {"channel", t.worst_channel}}},
      {"worst_probability", t.worst_probability},
      {"equal", t.equal}};
}

void print_z_test(const ZTest& t) {
  fmt::print("\nz-test: {} scores, {} values exact and equal, {} without a score and unequal\n", t.count,
             t.exact, t.faults);
  fmt::print("  beyond 2 standard errors  {:.3f} %  (expected {:.3f})\n", 100 * t.share_beyond_2,
             100 * share_expected_beyond_2);
  fmt::print("  beyond 3 standard errors  {:.3f} %  (expected {:.3f})\n", 100 * t.share_beyond_3,
             100 * share_expected_beyond_3);
  fmt::print("  mean square of scores     {:.4f}  (expected 1; {:+.1f} standard errors of it)\n",
             t.mean_square, t.mean_square_score);
  fmt::print("  A as a whole              {:+.1f} standard errors of the mean score {} B\n", t.mean_score,
             t.mean_score < 0 ? "below" : "above");
  fmt::print("  worst value               {:+.2f} at {}, {} channel {}; so far out by chance: {:.3g}\n",
             t.worst_score, t.worst_x, t.worst_y, t.worst_channel, t.worst_probability);
  fmt::print("  {}\n", t.equal ? "equal within their errors (1 % significance)"
                               : "not equal within their errors (1 % significance)");
}

ShownPictures show_pictures(const LoadedImage& a, const LoadedImage& b) {
  const double exposure = automatic_exposure_ev(is_shown_as_it_is(b) ? a.flat : b.flat);
  return {shown(a, exposure), shown(b, exposure)};
}

PerceptualDifference perceptual_difference(const ShownPictures& pictures, double pixels_per_degree) {
  return perceptual_difference(linear(pictures.a), linear(pictures.b), PerceptualOptions{pixels_per_degree});
}

nlohmann::ordered_json perceptual_json(const PerceptualDifference& difference, double pixels_per_degree) {
  return {{"pixels_per_degree", pixels_per_degree},
          {"mean", difference.mean},
          {"median", difference.median},
          {"largest", difference.largest}};
}

}  // namespace welkin
