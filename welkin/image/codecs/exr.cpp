#include <welkin/image/codecs/exr.h>

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/chromaticities.h>
#include <welkin/image/codecs/exr_header.h>
#include <welkin/image/codecs/size_limit.h>

namespace welkin {
namespace {

// The file in memory, its first bytes replaced by the checked headers.
class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> headers)
      : IStream("memory"), bytes_(bytes), headers_(headers) {}
  bool read(char data[], int count) override {
    if (count < 0 || position_ > bytes_.size() ||
        bytes_.size() - position_ < static_cast<std::size_t>(count)) {
      throw Iex::InputExc("the file is cut off");
    }
    const auto size = static_cast<std::size_t>(count);
    std::memcpy(data, bytes_.data() + position_, size);
    if (position_ < headers_.size()) {
      std::memcpy(data, headers_.data() + position_, std::min(size, headers_.size() - position_));
    }
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::uint8_t> bytes_, headers_;
  std::size_t position_ = 0;
};

enum class ColourKind { rgb, luminance_chroma, gray };

struct ColourChannels {
  ColourKind kind = ColourKind::rgb;
  std::array<std::string, 3>
      names;  // empty: absent, zero. Luminance-chroma: RY, Y, BY. Gray: only the first.
};

// "light.key" for the channel light.key.R; nothing for a channel without a layer or with another last part.
std::optional<std::string> layer_of(const std::string& channel, std::string_view last) {
  const std::size_t dot = channel.rfind('.');
  if (dot == std::string::npos || channel.substr(dot + 1) != last) return std::nullopt;
  return channel.substr(0, dot);
}

std::optional<ColourChannels> colour_of_default_layer(const Imf::ChannelList& channels, LoadedImage& loaded) {
  const auto has = [&](const char* channel) { return channels.findChannel(channel) != nullptr; };
  if (has("R") || has("G") || has("B")) {
    ColourChannels result;
    int channel = 0;
    for (const char* letter : {"R", "G", "B"}) {
      if (has(letter)) {
        result.names[channel] = letter;
      } else {
        loaded.warnings.push_back(fmt::format("has no channel {}; it is taken as 0", letter));
      }
      ++channel;
    }
    return result;
  }
  if (has("Y") && has("RY") && has("BY"))
    return ColourChannels{ColourKind::luminance_chroma, {"RY", "Y", "BY"}};
  if (has("Y")) return ColourChannels{ColourKind::gray, {"Y", "", ""}};
  return std::nullopt;
}

std::optional<ColourChannels> colour_of_first_layer(const Imf::ChannelList& channels, LoadedImage& loaded) {
  for (auto i = channels.begin(); i != channels.end(); ++i) {
    const std::optional<std::string> layer = layer_of(i.name(), "R");
    if (!layer || !channels.findChannel(*layer + ".G") || !channels.findChannel(*layer + ".B")) continue;
    loaded.warnings.push_back(fmt::format("has no default layer; the layer '{}' is used", *layer));
    return ColourChannels{ColourKind::rgb, {*layer + ".R", *layer + ".G", *layer + ".B"}};
  }
  return std::nullopt;
}

ColourChannels choose_channels(const Imf::ChannelList& channels, std::string_view name, LoadedImage& loaded) {
  if (const auto colour = colour_of_default_layer(channels, loaded)) return *colour;
  if (const auto colour = colour_of_first_layer(channels, loaded)) return *colour;
  std::string list;
  int count = 0;
  for (auto i = channels.begin(); i != channels.end(); ++i, ++count) {
    if (count < 20) list += fmt::format("{}{}", list.empty() ? "" : ", ", i.name());
  }
  if (count != 1) throw Error(name, fmt::format("has no channels R, G, B or Y, only: {}", list));
  loaded.warnings.push_back(fmt::format("has one channel, '{}'; it is taken as gray", list));
  return {ColourKind::gray, {list, "", ""}};
}

std::int64_t width_of(const Imath::Box2i& box) { return std::int64_t{box.max.x} - box.min.x + 1; }
std::int64_t height_of(const Imath::Box2i& box) { return std::int64_t{box.max.y} - box.min.y + 1; }

// What the library will allocate follows from the header alone, so the header has to be plausible first.
void check_header(const Imf::Header& header, std::string_view name, std::size_t byte_count) {
  double bytes_per_pixel = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    const Imf::Channel& channel = i.channel();
    const double size = channel.type == Imf::HALF ? 2 : 4;
    bytes_per_pixel += size / std::max(1.0, static_cast<double>(channel.xSampling) * channel.ySampling);
  }
  // Deflate ends at 1032 : 1; DWA drops the zero coefficients of its 8 x 8 blocks before it deflates.
  const bool dwa =
      header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
  const double compression_ratio = dwa ? 1032 * 128 : 4096;
  const Imath::Box2i& data = header.dataWindow();
  const Imath::Box2i& display = header.displayWindow();
  check_image_size(name, width_of(data), height_of(data), byte_count, compression_ratio / bytes_per_pixel);
  const double data_pixels = static_cast<double>(width_of(data)) * static_cast<double>(height_of(data));
  const double free_pixels = static_cast<double>(max_pixel_count) / 32;  // how much may hold nothing at all
  check_image_size(name, width_of(display), height_of(display), 1, std::max(free_pixels, 64 * data_pixels));
  if (!header.hasTileDescription()) return;
  const Imf::TileDescription& tile = header.tileDescription();
  if (static_cast<double>(tile.xSize) * tile.ySize > std::max(free_pixels, 4 * data_pixels)) {
    throw Error(name,
                fmt::format("the header gives tiles of {} x {}; it is damaged", tile.xSize, tile.ySize));
  }
}

// A subsampled channel: sample (i, j) sits on the pixel (i xs, j ys) of the data window.
struct Plane {
  int width = 0, height = 0, x_step = 1, y_step = 1;
  std::vector<float> samples;

  float at(int x, int y) const {
    const int x0 = x / x_step, y0 = y / y_step;
    const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    const float fx = static_cast<float>(x % x_step) / static_cast<float>(x_step);
    const float fy = static_cast<float>(y % y_step) / static_cast<float>(y_step);
    const auto value = [&](int i, int j) { return samples[static_cast<std::size_t>(j) * width + i]; };
    return (1 - fy) * ((1 - fx) * value(x0, y0) + fx * value(x1, y0)) +
           fy * ((1 - fx) * value(x0, y1) + fx * value(x1, y1));
  }
};

Imf::Slice slice_of(Plane& plane, const Imath::Box2i& window) {
  return Imf::Slice::Make(Imf::FLOAT, plane.samples.data(), window, sizeof(float),
                          sizeof(float) * plane.width, plane.x_step, plane.y_step);
}

Plane make_plane(const Imf::Channel& channel, const Image& image) {
  Plane plane{image.width / channel.xSampling,
              image.height / channel.ySampling,
              channel.xSampling,
              channel.ySampling,
              {}};
  plane.samples.resize(static_cast<std::size_t>(plane.width) * plane.height);
  return plane;
}

// The three channels over the data window, subsampled ones interpolated.
Image read_data_window(Imf::MultiPartInputFile& file, int part_index, const ColourChannels& colour) {
  Imf::InputPart part(file, part_index);
  const Imath::Box2i window = part.header().dataWindow();
  Image image(static_cast<int>(width_of(window)), static_cast<int>(height_of(window)));
  Imf::FrameBuffer buffer;
  std::array<Plane, 3> planes;
  for (int c = 0; c < 3; ++c) {
    if (colour.names[c].empty()) continue;
    const Imf::Channel& channel = part.header().channels()[colour.names[c]];
    if (channel.xSampling == 1 && channel.ySampling == 1) {
      buffer.insert(colour.names[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window,
                                                      3 * sizeof(float), 3 * sizeof(float) * image.width));
    } else {
      planes[c] = make_plane(channel, image);
      buffer.insert(colour.names[c], slice_of(planes[c], window));
    }
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  for (int c = 0; c < 3; ++c) {
    if (planes[c].samples.empty()) continue;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) image.at(x, y)[c] = planes[c].at(x, y);
    }
  }
  return image;
}

Chromaticities chromaticities_of(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return {};
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  const auto xy = [](const Imath::V2f& v) { return std::array<double, 2>{v.x, v.y}; };
  return {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)};
}

bool is_rec709(const Chromaticities& c) {
  const Chromaticities d;
  const auto near = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::abs(a[0] - b[0]) < 1e-3 && std::abs(a[1] - b[1]) < 1e-3;
  };
  return near(c.red, d.red) && near(c.green, d.green) && near(c.blue, d.blue) && near(c.white, d.white);
}

// RY = (R - Y)/Y, BY = (B - Y)/Y and Y = wr R + wg G + wb B, with the luminance weights of the file's
// primaries (OpenEXR, Technical Introduction, "Luminance/Chroma Images").
void luminance_chroma_to_rgb(Image& image, const Chromaticities& primaries) {
  ColourMatrix to_xyz = rgb_to_xyz(primaries);
  if (to_xyz[4] == 0) to_xyz = rgb_to_xyz({});
  const float wr = static_cast<float>(to_xyz[3]), wg = static_cast<float>(to_xyz[4]);
  const float wb = static_cast<float>(to_xyz[5]);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    float* p = image.pixels.data() + i;
    const float luminance = p[1];
    p[0] = (p[0] + 1) * luminance;
    p[2] = (p[2] + 1) * luminance;
    p[1] = (luminance - wr * p[0] - wb * p[2]) / wg;
  }
}

void convert_colour(const Imf::Header& header, const ColourChannels& colour, Image& image,
                    LoadedImage& loaded) {
  const Chromaticities primaries = chromaticities_of(header);
  if (colour.kind == ColourKind::luminance_chroma) luminance_chroma_to_rgb(image, primaries);
  if (colour.kind == ColourKind::gray) {
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
      image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
    return;
  }
  if (is_rec709(primaries)) return;
  const ColourMatrix matrix = rgb_to_rec709(primaries);
  if (matrix == ColourMatrix{}) {
    loaded.warnings.push_back("has impossible chromaticities; the colours are taken as Rec.709");
    return;
  }
  loaded.warnings.push_back("has primaries other than Rec.709; the colours are converted");
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) transform_colour(matrix, image.pixels.data() + i);
}

Image crop_to_display(Image&& data, const Imf::Header& header, LoadedImage& loaded) {
  const Imath::Box2i& from = header.dataWindow();
  const Imath::Box2i& to = header.displayWindow();
  if (from == to) return std::move(data);
  Image image(static_cast<int>(width_of(to)), static_cast<int>(height_of(to)));
  const int x0 = std::max(from.min.x, to.min.x), x1 = std::min(from.max.x, to.max.x);
  const int y0 = std::max(from.min.y, to.min.y), y1 = std::min(from.max.y, to.max.y);
  for (int y = y0; y <= y1 && x0 <= x1; ++y) {
    const float* source = data.at(x0 - from.min.x, y - from.min.y);
    std::copy(source, source + std::size_t{3} * (x1 - x0 + 1), image.at(x0 - to.min.x, y - to.min.y));
  }
  if (from.min.x > to.min.x || from.min.y > to.min.y || from.max.x < to.max.x || from.max.y < to.max.y) {
    loaded.warnings.push_back("the data window does not cover the display window; the rest is black");
  }
  if (from.min.x < to.min.x || from.min.y < to.min.y || from.max.x > to.max.x || from.max.y > to.max.y) {
    loaded.warnings.push_back("the data window is larger than the display window; the overscan is cropped");
  }
  return image;
}

int first_flat_part(Imf::MultiPartInputFile& file, std::string_view name, LoadedImage& loaded) {
  for (int i = 0; i < file.parts(); ++i) {
    const Imf::Header& header = file.header(i);
    if (header.hasType() && Imf::isDeepData(header.type())) continue;
    if (file.parts() > 1) {
      loaded.warnings.push_back(fmt::format("has {} parts; only part {} is used", file.parts(), i));
    }
    return i;
  }
  throw Error(name, "holds deep images only; flatten it first");
}

void undo_stored_scale(const Imf::Header& header, Image& image) {
  const auto* scale = header.findTypedAttribute<Imf::DoubleAttribute>("welkinStoredScale");
  if (!scale || !(scale->value() > 0) || !std::isfinite(scale->value())) return;
  for (float& value : image.pixels) value *= static_cast<float>(scale->value());
}

LoadedImage decode(std::span<const std::uint8_t> bytes, std::string_view name) {
  Imf::setGlobalThreadCount(0);
  const std::vector<std::uint8_t> headers = checked_exr_headers(bytes, name);
  MemoryInput stream(bytes, headers);
  Imf::MultiPartInputFile file(stream, 0);
  LoadedImage loaded;
  loaded.format = "OpenEXR";
  const int part = first_flat_part(file, name, loaded);
  const Imf::Header header = file.header(part);
  check_header(header, name, bytes.size());
  const ColourChannels colour = choose_channels(header.channels(), name, loaded);
  Image image = read_data_window(file, part, colour);
  convert_colour(header, colour, image, loaded);
  loaded.flat = crop_to_display(std::move(image), header, loaded);
  undo_stored_scale(header, loaded.flat);
  return loaded;
}

// Messages of the library can have several lines.
std::string first_line(const char* message) {
  const std::string_view text(message);
  return std::string(text.substr(0, text.find('\n')));
}

}  // namespace

LoadedImage decode_exr(std::span<const std::uint8_t> bytes, std::string_view name) {
  try {
    return decode(bytes, name);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(name, "there is not enough memory for this OpenEXR file");
  } catch (const std::exception& error) {
    throw Error(name, "cannot read as OpenEXR: " + first_line(error.what()));
  }
}

}  // namespace welkin
