#include <welkin/image/codecs/exr_layers.h>

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>

#include <welkin/error.h>
#include <welkin/image/codecs/exr_header.h>
#include <welkin/image/codecs/size_limit.h>

namespace welkin {
namespace {

constexpr const char* freedom_attribute = "welkinErrorFreedom";

// As in exr.cpp: the file in memory, its first bytes replaced by the checked headers. The library's types may stand in no
// header of ours, so both readers have one.
class Input : public Imf::IStream {
 public:
  Input(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> headers)
      : IStream("memory"), bytes_(bytes), headers_(headers) {}
  bool read(char data[], int count) override {
    if (count < 0 || position_ > bytes_.size() || bytes_.size() - position_ < static_cast<std::size_t>(count))
      throw Iex::InputExc("the file is cut off");
    const auto size = static_cast<std::size_t>(count);
    std::memcpy(data, bytes_.data() + position_, size);
    if (position_ < headers_.size())
      std::memcpy(data, headers_.data() + position_, std::min(size, headers_.size() - position_));
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::uint8_t> bytes_, headers_;
  std::size_t position_ = 0;
};

class Output : public Imf::OStream {
 public:
  Output() : OStream("memory") {}
  void write(const char data[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes.size() < position_ + size) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, data, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> bytes;

 private:
  std::size_t position_ = 0;
};

std::string full_name(const ExrLayer& layer, std::size_t channel) {
  return layer.name.empty() ? layer.channels[channel] : layer.name + "." + layer.channels[channel];
}

// A frame buffer is for reading and writing alike, so it has no const; writing leaves the pixels alone.
template <class Insert>
void for_each_channel(std::span<const ExrLayer> layers, const Insert& insert) {
  for (const ExrLayer& layer : layers) {
    char* base = const_cast<char*>(reinterpret_cast<const char*>(layer.image.pixels.data()));
    for (std::size_t c = 0; c < layer.channels.size(); ++c)
      insert(full_name(layer, c), base + c * sizeof(float), layer.channels.size() * sizeof(float));
  }
}

std::int64_t width_of(const Imath::Box2i& box) { return std::int64_t{box.max.x} - box.min.x + 1; }
std::int64_t height_of(const Imath::Box2i& box) { return std::int64_t{box.max.y} - box.min.y + 1; }

int first_flat_part(const Imf::MultiPartInputFile& file, std::string_view name) {
  for (int i = 0; i < file.parts(); ++i)
    if (!file.header(i).hasType() || !Imf::isDeepData(file.header(i).type())) return i;
  throw Error(name, "holds deep images only; flatten it first");
}

// What the library and we will allocate follows from the header alone, so it has to be plausible first.
void check_header(const Imf::Header& header, std::string_view name, std::size_t byte_count) {
  double bytes_per_pixel = 0, channels = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i, ++channels) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
      throw Error(name, std::string("has the subsampled channel ") + i.name());
    bytes_per_pixel += i.channel().type == Imf::HALF ? 2 : 4;
  }
  if (channels == 0) throw Error(name, "has no channels");
  const bool dwa =
      header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
  const double compression_ratio = dwa ? 1032 * 128 : 4096;  // as exr.cpp has it
  const Imath::Box2i& data = header.dataWindow();
  check_image_size(name, width_of(data), height_of(data), byte_count, compression_ratio / bytes_per_pixel);
  const double values = static_cast<double>(width_of(data)) * static_cast<double>(height_of(data)) * channels;
  if (values > static_cast<double>(max_pixel_count) * 4)
    throw Error(name, "has too many channels for its size");
  if (!header.hasTileDescription()) return;
  const double tile = static_cast<double>(header.tileDescription().xSize) * header.tileDescription().ySize;
  if (tile * channels > std::max(static_cast<double>(max_pixel_count) / 32, 4 * values))
    throw Error(name, "the header gives impossible tiles; it is damaged");
}

int rank(const std::string& channel) {
  constexpr std::string_view first = "RGBA";
  const auto at = channel.size() == 1 ? first.find(channel[0]) : std::string_view::npos;
  return at == std::string_view::npos ? 4 : static_cast<int>(at);
}

std::vector<ExrLayer> layers_of(const Imf::Header& header) {
  std::map<std::string, std::vector<std::string>> named;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    const std::string full = i.name();
    const std::size_t dot = full.rfind('.');
    if (dot == std::string::npos) {
      named[""].push_back(full);
    } else {
      named[full.substr(0, dot)].push_back(full.substr(dot + 1));
    }
  }
  const int width = static_cast<int>(width_of(header.dataWindow()));
  const int height = static_cast<int>(height_of(header.dataWindow()));
  std::vector<ExrLayer> layers;
  for (auto& [name, channels] : named) {
    std::stable_sort(channels.begin(), channels.end(),
                     [](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
    layers.push_back({name, channels, Image(width, height, static_cast<int>(channels.size()))});
  }
  return layers;
}

ExrLayers decode(std::span<const std::uint8_t> bytes, std::string_view name) {
  Imf::setGlobalThreadCount(0);
  const std::vector<std::uint8_t> headers = checked_exr_headers(bytes, name);
  Input stream(bytes, headers);
  Imf::MultiPartInputFile file(stream, 0);
  const int index = first_flat_part(file, name);
  check_header(file.header(index), name,
               bytes.size());  // before an InputPart takes memory for its lines or tiles
  Imf::InputPart part(file, index);
  const Imf::Header& header = part.header();
  ExrLayers result;
  result.layers = layers_of(header);
  if (const auto* freedom = header.findTypedAttribute<Imf::DoubleAttribute>(freedom_attribute))
    if (freedom->value() >= 1 && std::isfinite(freedom->value()))
      result.error_degrees_of_freedom = freedom->value();
  const Imath::Box2i window = header.dataWindow();
  Imf::FrameBuffer buffer;
  for_each_channel(result.layers, [&](const std::string& channel, char* base, std::size_t stride) {
    buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT, base, window, stride,
                                            stride * static_cast<std::size_t>(width_of(window))));
  });
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  return result;
}

std::vector<std::uint8_t> encode(const ExrLayers& layers) {
  Imf::setGlobalThreadCount(0);
  const Image& first = layers.layers.front().image;
  Imf::Header header(first.width, first.height, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y,
                     Imf::ZIP_COMPRESSION);
  Imf::FrameBuffer buffer;
  for_each_channel(layers.layers, [&](const std::string& channel, char* base, std::size_t stride) {
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    buffer.insert(channel,
                  Imf::Slice(Imf::FLOAT, base, stride, stride * static_cast<std::size_t>(first.width)));
  });
  if (layers.error_degrees_of_freedom)
    header.insert(freedom_attribute, Imf::DoubleAttribute(*layers.error_degrees_of_freedom));
  Output stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(first.height);
  }
  return std::move(stream.bytes);
}

std::string first_line(const char* message) {
  const std::string_view text(message);
  return std::string(text.substr(0, text.find('\n')));
}

}  // namespace

std::vector<std::uint8_t> encode_exr_layers(const ExrLayers& layers) {
  assert(!layers.layers.empty() && layers.layers.front().image.width > 0);
  for ([[maybe_unused]] const ExrLayer& layer : layers.layers) {
    assert(layer.image.channels == static_cast<int>(layer.channels.size()));
    assert(layer.image.width == layers.layers.front().image.width);
    assert(layer.image.height == layers.layers.front().image.height);
  }
  try {
    return encode(layers);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error("cannot encode as OpenEXR: " + first_line(error.what()));
  }
}

ExrLayers decode_exr_layers(std::span<const std::uint8_t> bytes, std::string_view name) {
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

const ExrLayer* find_layer(const ExrLayers& layers, std::string_view name,
                           std::span<const std::string_view> channels) {
  for (const ExrLayer& layer : layers.layers)
    if (layer.name == name &&
        std::equal(layer.channels.begin(), layer.channels.end(), channels.begin(), channels.end()))
      return &layer;
  return nullptr;
}

}  // namespace welkin
