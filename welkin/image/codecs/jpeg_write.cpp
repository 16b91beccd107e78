#include <turbojpeg.h>

#include <cassert>
#include <memory>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>

namespace welkin {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
struct Free {
  void operator()(unsigned char* bytes) const { tjFree(bytes); }
};

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const ByteImage& image, int quality) {
  assert(image.channels == 1 || image.channels == 3);
  const std::unique_ptr<void, Destroy> jpeg(tjInitCompress());
  if (!jpeg) throw Error("cannot write a JPEG: out of memory");
  const bool gray = image.channels == 1;
  unsigned char* written = nullptr;
  unsigned long size = 0;
  const int result =
      tjCompress2(jpeg.get(), image.pixels.data(), image.width, 0, image.height, gray ? TJPF_GRAY : TJPF_RGB,
                  &written, &size, gray ? TJSAMP_GRAY : TJSAMP_444, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, Free> owned(written);
  if (result != 0) throw Error(std::string("cannot write a JPEG: ") + tjGetErrorStr2(jpeg.get()));
  return {written, written + size};
}

}  // namespace welkin
