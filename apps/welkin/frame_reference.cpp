#include "frame_reference.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include <welkin/comparison/difference_picture.h>
#include <welkin/error.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/output_file.h>
#include <welkin/realtime/viewer/false_color.h>

#include "flat_file.h"
#include "picture.h"
#include "progress.h"
#include "stop_signal.h"

namespace welkin {
namespace {

constexpr std::uint32_t default_samples = 256;

// Nothing for what is no number.
std::optional<std::uint32_t> reference_samples(const std::string& text) {
  if (text.empty()) return default_samples;
  std::uint32_t samples = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, samples);
  if (rest != end) return std::nullopt;
  if (error != std::errc() || samples < 1 || samples > 1u << 20)
    throw CLI::ValidationError("--reference", "takes 1 to 1048576 samples a pixel, not " + text);
  return samples;
}

const Image* layer(const ExrLayers& layers, std::string_view name,
                   std::span<const std::string_view> channels) {
  const ExrLayer* found = find_layer(layers, name, channels);
  return found != nullptr ? &found->image : nullptr;
}

TruthPicture read_truth(const std::string& name, PictureSize size) {
  constexpr std::string_view rgb[] = {"R", "G", "B"}, y[] = {"Y"};
  const ExrLayers layers = decode_exr_layers(read_file(name), name);
  const Image *radiance = layer(layers, "", rgb), *error = layer(layers, "stderr", rgb),
              *coverage = layer(layers, "coverage", y);
  if (radiance == nullptr || coverage == nullptr)
    throw Error(name, "has no layers R, G, B and coverage.Y, which welkin render writes");
  if (radiance->width != size.width || radiance->height != size.height)
    throw Error(name, fmt::format("is {} x {}, the picture {} x {}", radiance->width, radiance->height,
                                  size.width, size.height));
  return {*radiance, error != nullptr ? *error : Image(size.width, size.height, 3), *coverage};
}

std::string difference_caption(double share) { return fmt::format("-+ {:g} percent of the mean", 100 * share); }

ByteImage toned(const Image& picture, const ToneMapOptions& tone) {
  Image rgb(picture.width, picture.height, 3);
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t i = 0; i < rgb.pixels.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgb.pixels[3 * i + c] = picture.pixels[channels * i + c];
  return tone_map(rgb, tone);
}

constexpr int margin = 4, line = text_height + margin;
constexpr ByteColour ink{230, 230, 230};

}  // namespace

void check_reference(const FrameCommand& command) {
  if (!command.reference_given) {
    if (!command.sheet.empty()) throw CLI::ValidationError("--sheet", "is for --reference");
    return;
  }
  const bool file = !reference_samples(command.reference);
  if (file && extension_of(command.reference) != ".exr")
    throw CLI::ValidationError("--reference",
                               "is a number of samples or a FILE.exr, not " + command.reference);
  if (command.sheet.empty()) return;
  const std::string extension = extension_of(command.sheet);
  if (extension != ".png" && extension != ".jpg" && extension != ".jpeg")
    throw CLI::ValidationError("--sheet", "is a FILE.png or FILE.jpg, not " + command.sheet);
  if (command.sheet == command.output) throw CLI::ValidationError("--sheet", "is the same file as --output");
  for (const std::string& input : {command.file, command.environment, command.reference})
    check_output(command.sheet, input);
}

TruthPicture make_truth(const FrameCommand& command, const FrameJob& job) {
  const auto samples = reference_samples(command.reference);
  if (!samples) return read_truth(command.reference, job.size);
  const StopLater stop;
  ProgressLine progress("rendering the truth");
  TruthOptions options;
  options.samples = *samples;
  options.observer = [&](const PictureProgress& at) {
    progress.show(at.share);
    return stop.signal_number() == 0;
  };
  TruthPicture truth = render_truth(*job.renderer, *job.light, job.size, options);
  if (stop.signal_number() != 0) throw Stopped(stop.signal_number(), "stopped; nothing was written");
  return truth;
}

std::string beside_name(const std::string& output, const std::string& suffix) {
  const auto dot = output.size() - extension_of(output).size();
  return output.substr(0, dot) + suffix;
}

ByteImage draw_difference(const Image& picture, const TruthPicture& truth, const PictureErrors& errors) {
  const double share = nice_scale(errors.p99);
  const ByteImage difference = difference_picture(picture, truth, share * errors.truth_mean);
  const ByteImage legend = difference_legend(difference.width, 2 * margin);
  ByteImage result(difference.width, difference.height + legend.height + margin + line, 3);
  blit(difference, result, 0, 0);
  blit(legend, result, 0, difference.height + margin);
  draw_text(result, margin, difference.height + legend.height + 2 * margin, 1, difference_caption(share),
            ink);
  return result;
}

ByteImage draw_sheet(const FrameReport& report, const Image& picture, const TruthPicture& truth,
                     const ToneMapOptions& tone) {
  ToneMapOptions options = tone;
  if (!options.exposure_ev) options.exposure_ev = automatic_exposure_ev(truth.radiance);
  const ByteImage parts[] = {toned(picture, options), toned(truth.radiance, options),
                             draw_difference(picture, truth, *report.errors)};
  const std::string captions[] = {report.technique, "truth: " + report.truth,
                                  fmt::format("error {:.2g} percent", 100 * report.errors->mean_absolute)};
  ByteImage sheet(3 * picture.width + 4 * margin, parts[2].height + line + margin, 3);
  for (int i = 0; i < 3; ++i) {
    const int x = margin + i * (picture.width + margin);
    draw_text(sheet, x, margin, 1, captions[i], ink);
    blit(parts[i], sheet, x, margin + line);
  }
  return sheet;
}

}  // namespace welkin
