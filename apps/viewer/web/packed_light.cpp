#include "packed_light.h"

#include <cstring>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr std::uint32_t format_version = 1;

// One list of what is stored serves both ways: Stream is a Writer or a Reader.
class Writer {
 public:
  template <class T>
  void number(const T& value) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
  template <class T>
  void numbers(const std::vector<T>& values) {
    number(static_cast<std::uint32_t>(values.size()));
    const auto* from = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes.insert(bytes.end(), from, from + sizeof(T) * values.size());
  }
  template <class T>
  void count(const std::vector<T>& items) {
    number(static_cast<std::uint32_t>(items.size()));
  }

  std::vector<std::uint8_t> bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class T>
  void number(T& value) {
    take(&value, sizeof value);
  }
  template <class T>
  void numbers(std::vector<T>& values) {
    count(values, sizeof(T));
    take(values.data(), sizeof(T) * values.size());
  }
  template <class T>
  void count(std::vector<T>& items, std::size_t least_bytes = 1) {
    std::uint32_t size = 0;
    number(size);
    if (size > bytes_.size() / least_bytes) throw Error("packed maps are cut off");
    items.resize(size);
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size()) throw Error("packed maps are cut off");
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::uint8_t> bytes_;
};

template <class Stream, class ImageOrConst>
void pass_image(Stream& stream, ImageOrConst& image) {
  stream.number(image.width);
  stream.number(image.height);
  stream.number(image.channels);
  stream.numbers(image.pixels);
}

template <class Stream, class CubeOrConst>
void pass_cube(Stream& stream, CubeOrConst& cube) {
  stream.number(cube.size);
  stream.number(cube.channels);
  stream.numbers(cube.texels);
}

template <class Stream, class MipsOrConst>
void pass_mips(Stream& stream, MipsOrConst& mips) {
  stream.count(mips.levels);
  for (auto& level : mips.levels) pass_cube(stream, level);
}

template <class Stream, class LightOrConst>
void pass_light(Stream& stream, LightOrConst& light) {
  pass_image(stream, light.radiance);
  auto& maps = light.maps;
  pass_mips(stream, maps.environment);
  pass_mips(stream, maps.specular);
  stream.count(maps.levels);
  for (auto& level : maps.levels) {
    stream.number(level.perceptual_roughness);
    stream.number(level.alpha);
  }
  pass_cube(stream, maps.irradiance);
  stream.number(maps.radiance_sh.max_degree);
  stream.number(maps.radiance_sh.channels);
  stream.numbers(maps.radiance_sh.values);
  stream.number(maps.dfg.size);
  stream.numbers(maps.dfg.scale_bias);
}

}  // namespace

std::vector<std::uint8_t> pack_light(const EnvironmentData& light) {
  Writer writer;
  writer.number(format_version);
  pass_light(writer, light);
  return std::move(writer.bytes);
}

std::shared_ptr<const EnvironmentData> unpack_light(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  std::uint32_t version = 0;
  reader.number(version);
  if (version != format_version) throw Error("packed maps are of another version");
  auto light = std::make_shared<EnvironmentData>();
  pass_light(reader, *light);
  return light;
}

}  // namespace welkin
