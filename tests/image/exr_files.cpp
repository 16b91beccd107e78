#include <tests/image/exr_files.h>

#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>

namespace welkin {
namespace {

std::size_t size_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

void store(char* at, Imf::PixelType type, float value) {
  const half as_half(value);
  const auto as_uint = static_cast<unsigned>(std::max(value, 0.0f));
  const void* source = type == Imf::HALF   ? static_cast<const void*>(&as_half)
                       : type == Imf::UINT ? static_cast<const void*>(&as_uint)
                                           : static_cast<const void*>(&value);
  std::memcpy(at, source, size_of(type));
}

// The samples of one channel over a window, and the slice that shows them to OpenEXR.
struct ChannelMemory {
  std::vector<char> bytes;
  Imf::Slice slice;
};

ChannelMemory fill(const ExrChannel& channel, const Imath::Box2i& window) {
  const int width = (window.max.x - window.min.x) / channel.sampling + 1;
  const int height = (window.max.y - window.min.y) / channel.sampling + 1;
  const std::size_t size = size_of(channel.type);
  ChannelMemory memory;
  memory.bytes.resize(size * width * height);
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const float value =
          channel.value(window.min.x + i * channel.sampling, window.min.y + j * channel.sampling);
      store(memory.bytes.data() + size * (static_cast<std::size_t>(j) * width + i), channel.type, value);
    }
  }
  memory.slice = Imf::Slice::Make(channel.type, memory.bytes.data(), window, size, size * width,
                                  channel.sampling, channel.sampling);
  return memory;
}

Imf::FrameBuffer frame_buffer(const std::vector<ExrChannel>& channels, const Imath::Box2i& window,
                              std::vector<ChannelMemory>& memory) {
  Imf::FrameBuffer buffer;
  for (const ExrChannel& channel : channels) {
    memory.push_back(fill(channel, window));
    buffer.insert(channel.name, memory.back().slice);
  }
  return buffer;
}

}  // namespace

Imf::Header exr_header(const ExrForm& form, const std::vector<ExrChannel>& channels) {
  Imf::Header header(form.display, form.data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, form.compression);
  for (const ExrChannel& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.type, channel.sampling, channel.sampling));
  }
  if (form.tile > 0) {
    const auto size = static_cast<unsigned>(form.tile);
    header.setTileDescription({size, size, form.mip_levels ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL});
  }
  return header;
}

std::vector<std::uint8_t> exr_file(const Imf::Header& header, const std::vector<ExrChannel>& channels) {
  ExrBytes stream;
  std::vector<ChannelMemory> memory;
  if (!header.hasTileDescription()) {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame_buffer(channels, header.dataWindow(), memory));
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
  } else {
    Imf::TiledOutputFile file(stream, header);
    for (int level = 0; level < file.numLevels(); ++level) {
      file.setFrameBuffer(frame_buffer(channels, file.dataWindowForLevel(level), memory));
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  }
  return stream.bytes;
}

}  // namespace welkin
