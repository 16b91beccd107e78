#include <welkin/image/codecs/exr_header.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

struct KnownAttribute {
  std::string_view name, type;
  std::int64_t size;  // any_size, or what the type always has
};

constexpr std::int64_t any_size = -1;
constexpr KnownAttribute known_attributes[] = {
    {"channels", "chlist", any_size},
    {"compression", "compression", 1},
    {"dataWindow", "box2i", 16},
    {"displayWindow", "box2i", 16},
    {"lineOrder", "lineOrder", 1},
    {"pixelAspectRatio", "float", 4},
    {"screenWindowCenter", "v2f", 8},
    {"screenWindowWidth", "float", 4},
    {"tiles", "tiledesc", 9},
    {"name", "string", any_size},
    {"type", "string", any_size},
    {"chunkCount", "int", 4},
    {"version", "int", 4},
    {"maxSamplesPerPixel", "int", 4},
    {"chromaticities", "chromaticities", 32},
    {"welkinStoredScale", "double", 8},
    {"welkinErrorFreedom", "double", 8},
};

class HeaderWalk {
 public:
  HeaderWalk(std::span<const std::uint8_t> bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::vector<std::uint8_t> run() {
    constexpr std::uint32_t magic = 20000630, multi_part = 0x1000;
    if (number() != magic) fail("not an OpenEXR file");
    const bool several = (number() & multi_part) != 0;
    do {
      while (attribute()) continue;
    } while (several && peek() != 0);
    if (several) take(1);
    const auto headers = bytes_.first(position_);
    std::vector<std::uint8_t> copy(headers.begin(), headers.end());
    for (std::size_t position : unknown_types_) copy[position] = '_';  // no type of the library begins so
    return copy;
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw Error(name_, std::string("cannot read as OpenEXR: ") + what);
  }

  std::size_t left() const { return bytes_.size() - position_; }
  std::uint8_t peek() const {
    if (left() == 0) fail("the header is cut off");
    return bytes_[position_];
  }
  std::span<const std::uint8_t> take(std::size_t count) {
    if (left() < count) fail("the header is cut off");
    position_ += count;
    return bytes_.subspan(position_ - count, count);
  }
  std::uint32_t number() {
    const auto b = take(4);
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
  }
  std::string_view text() {
    constexpr std::size_t longest = 255;
    const auto rest = bytes_.subspan(position_);
    const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
    const auto length = static_cast<std::size_t>(end - rest.begin());
    if (end == rest.end()) fail("the header is cut off");
    if (length > longest) fail("the header is damaged: a name is too long");
    take(length + 1);
    return {reinterpret_cast<const char*>(rest.data()), length};
  }

  // Name, type, size, value; an empty name ends the header.
  bool attribute() {
    const std::string_view name = text();
    if (name.empty()) return false;
    const std::size_t type_position = position_;
    const std::string_view type = text();
    const std::uint32_t size = number();
    if (size > left()) fail("the header is damaged: an attribute is larger than the file");
    const auto* known = std::find_if(std::begin(known_attributes), std::end(known_attributes),
                                     [&](const KnownAttribute& a) { return a.name == name; });
    if (known == std::end(known_attributes)) {
      if (!type.empty()) unknown_types_.push_back(type_position);
    } else if (type != known->type || (known->size != any_size && known->size != size)) {
      fail("the header is damaged: an attribute has the wrong type or size");
    }
    if (name == "channels") check_channels(size);
    if (name == "chunkCount") check_chunk_count();
    position_ += name == "channels" || name == "chunkCount" ? 0 : size;
    return true;
  }

  // Names, each with 16 bytes behind it, up to an empty name, which has to be where the attribute ends.
  void check_channels(std::size_t size) {
    const std::size_t end = position_ + size;
    while (!text().empty()) take(16);
    if (position_ != end) fail("the header is damaged: the list of channels has the wrong size");
  }

  void check_chunk_count() {
    if (number() > bytes_.size() / 8) fail("the header is damaged: more chunks than the file can hold");
  }

  std::span<const std::uint8_t> bytes_;
  std::vector<std::size_t> unknown_types_;  // where their names begin
  std::string_view name_;
  std::size_t position_ = 0;
};

}  // namespace

std::vector<std::uint8_t> checked_exr_headers(std::span<const std::uint8_t> bytes, std::string_view name) {
  return HeaderWalk(bytes, name).run();
}

}  // namespace welkin
