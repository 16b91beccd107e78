#include <welkin/error.h>
#include <welkin/image/codecs/astc.h>

// Stands for astc.cpp where there is no astcenc (the web build).

namespace welkin {

struct AstcEncoder::State {};
struct AstcDecoder::State {};

AstcEncoder::AstcEncoder(int, BlockQuality) { throw Error("ASTC cannot be written by this build"); }
AstcEncoder::~AstcEncoder() = default;
void AstcEncoder::encode(std::span<const float>, int, int, std::span<std::uint8_t>) {}

AstcDecoder::AstcDecoder(int) { throw Error("holds ASTC blocks, which this build cannot read"); }
AstcDecoder::~AstcDecoder() = default;
void AstcDecoder::decode(std::span<const std::uint8_t>, int, int, std::span<float>, std::string_view) {}

}  // namespace welkin
