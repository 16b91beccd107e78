#include <turbojpeg.h>

#include <memory>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr_samples.h>
#include <welkin/image/codecs/size_limit.h>

namespace welkin {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Decompressor = std::unique_ptr<void, Destroy>;

[[noreturn]] void fail(const Decompressor& jpeg, std::string_view name) {
  throw Error(name, std::string("cannot read this JPEG: ") + tjGetErrorStr2(jpeg.get()));
}

}  // namespace

LdrSamples read_jpeg(std::span<const std::uint8_t> bytes, std::string_view name) {
  const Decompressor jpeg(tjInitDecompress());
  if (!jpeg) throw Error(name, "cannot read this JPEG: out of memory");
  const auto size = static_cast<unsigned long>(bytes.size());
  LdrSamples samples;
  int subsampling = 0, colorspace = 0;
  if (tjDecompressHeader3(jpeg.get(), bytes.data(), size, &samples.width, &samples.height, &subsampling,
                          &colorspace) != 0) {
    fail(jpeg, name);
  }
  if (colorspace == TJCS_CMYK || colorspace == TJCS_YCCK) {
    throw Error(name, "this JPEG is for print (CMYK); convert it to RGB first");
  }
  check_image_size(name, samples.width, samples.height, bytes.size(),
                   8 * 64);  // a block of 8 x 8 takes a bit or more

  // A warning, for example of a file that is cut off, is damage. Without a limit on the scans of a progressive file, one of
  // a few kilobytes can keep the decoder busy for minutes.
  constexpr int flags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  samples.bytes.resize(std::size_t{3} * samples.width * samples.height);
  if (tjDecompress2(jpeg.get(), bytes.data(), size, samples.bytes.data(), samples.width, 0, samples.height,
                    TJPF_RGB, flags) != 0) {
    fail(jpeg, name);
  }
  return samples;
}

}  // namespace welkin
