#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/image/image.h>

namespace welkin {

/// Channels of an OpenEXR file that belong together: "albedo.R", "albedo.G", "albedo.B" are the layer "albedo" with the
/// channels R, G, B; channels without a dot are the layer "". image has one channel for each name, in their order.
struct ExrLayer {
  std::string name;
  std::vector<std::string> channels;
  Image image;
};

struct ExrLayers {
  std::vector<ExrLayer> layers;
  /// How many independent values each standard error of the layer "stderr" was told from, minus 1.
  std::optional<double> error_degrees_of_freedom;
};

/// One file with all channels as single floats, ZIP-compressed scan lines, Rec. 709. All images have the same size; no
/// two channels the same full name. decode_exr gives the R, G, B of the layer "".
std::vector<std::uint8_t> encode_exr_layers(const ExrLayers& layers);

/// Every channel of the first flat part, over its data window, as the file has it: no colours are converted. Layers in the
/// order of their names, channels R G B A first, then in the order of theirs. Throws Error naming `name` for anything
/// damaged, truncated, too large, deep only, or with subsampled channels.
ExrLayers decode_exr_layers(std::span<const std::uint8_t> bytes, std::string_view name);

/// The layer of that name with exactly these channels; nullptr where there is none.
const ExrLayer* find_layer(const ExrLayers& layers, std::string_view name,
                           std::span<const std::string_view> channels);

}  // namespace welkin
