#pragma once
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

// OpenEXR files written with OpenEXR's own interface, in the forms that welkin reads but does not write.

namespace welkin {

class ExrBytes : public Imf::OStream {
 public:
  ExrBytes() : OStream("test") {}
  void write(const char data[], int count) override {
    if (bytes.size() < position_ + count) bytes.resize(position_ + count);
    std::memcpy(bytes.data() + position_, data, static_cast<std::size_t>(count));
    position_ += static_cast<std::size_t>(count);
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::vector<std::uint8_t> bytes;

 private:
  std::size_t position_ = 0;
};

/// A channel whose value at the pixel (x, y) of the data window's coordinates is value(x, y), stored as `type`.
struct ExrChannel {
  std::string name;
  std::function<float(int x, int y)> value;
  Imf::PixelType type = Imf::FLOAT;
  int sampling = 1;
};

struct ExrForm {
  Imath::Box2i data{{0, 0}, {4, 3}};
  Imath::Box2i display = data;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  int tile = 0;  ///< 0: scan lines
  bool mip_levels = false;
};

Imf::Header exr_header(const ExrForm& form, const std::vector<ExrChannel>& channels);

/// A whole file; `header` is exr_header's, perhaps with attributes added.
std::vector<std::uint8_t> exr_file(const Imf::Header& header, const std::vector<ExrChannel>& channels);

}  // namespace welkin
