#include <welkin/image/codecs/astc.h>

#include <astcenc.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/half.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::size_t block_bytes = 16;

// How much brighter than the brightest texel of a block a decoded value may be: about the step between two end points
// of the coarser HDR modes. Near zero, the smallest normal half.
constexpr float overshoot = 1.01f, overshoot_at_zero = 0x1p-14f;

// What bright texels are limited to, relative to the brightest, from one attempt to the next.
constexpr std::array<float, 6> limits = {0.97f, 0.9f, 0.8f, 0.65f, 0.5f, 0.3f};

void check(astcenc_error error, const char* what) {
  if (error == ASTCENC_SUCCESS) return;
  throw Error(std::string("astcenc cannot ") + what + ": " + astcenc_get_error_string(error));
}

float preset(BlockQuality quality) {
  return quality == BlockQuality::fast     ? ASTCENC_PRE_FAST
         : quality == BlockQuality::normal ? ASTCENC_PRE_MEDIUM
                                           : ASTCENC_PRE_THOROUGH;
}

struct FreeContext {
  void operator()(astcenc_context* context) const { astcenc_context_free(context); }
};
using ContextPointer = std::unique_ptr<astcenc_context, FreeContext>;

constexpr astcenc_swizzle rgb1 = {ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_1};
constexpr astcenc_swizzle rgba = {ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};

// One context, which works on one image at a time with all threads. Each block is worked out by one thread from its own
// texels alone, so which thread takes which block changes nothing.
class Context {
 public:
  Context(int block, float quality, unsigned flags) : threads_(thread_count()) {
    assert(block == 4 || block == 6);
    astcenc_config config{};
    const auto side = static_cast<unsigned>(block);
    check(astcenc_config_init(ASTCENC_PRF_HDR_RGB_LDR_A, side, side, 1, quality, flags, &config),
          "be set up");
    astcenc_context* context = nullptr;
    check(astcenc_context_alloc(&config, static_cast<unsigned>(threads_), &context), "be started");
    context_.reset(context);
  }

  void compress(float* texels, int width, int height, std::span<std::uint8_t> blocks) {
    void* slice = texels;
    astcenc_image image = describe(width, height, &slice);
    run([&](unsigned thread) {
      return astcenc_compress_image(context_.get(), &image, &rgb1, blocks.data(), blocks.size(), thread);
    });
    check(astcenc_compress_reset(context_.get()), "encode");
  }

  void decompress(std::span<const std::uint8_t> blocks, int width, int height, float* texels) {
    void* slice = texels;
    astcenc_image image = describe(width, height, &slice);
    run([&](unsigned thread) {
      return astcenc_decompress_image(context_.get(), blocks.data(), blocks.size(), &image, &rgba, thread);
    });
    check(astcenc_decompress_reset(context_.get()), "decode");
  }

 private:
  static astcenc_image describe(int width, int height, void** slice) {
    return {static_cast<unsigned>(width), static_cast<unsigned>(height), 1, ASTCENC_TYPE_F32, slice};
  }

  // Whichever indices run at the same time share the work; one that comes late finds none left.
  template <class Call>
  void run(Call&& call) {
    std::vector<astcenc_error> errors(static_cast<std::size_t>(threads_), ASTCENC_SUCCESS);
    parallel_for(errors.size(), 1,
                 [&](std::size_t begin, std::size_t) { errors[begin] = call(static_cast<unsigned>(begin)); });
    for (const astcenc_error error : errors) check(error, "work on an image");
  }

  int threads_;
  ContextPointer context_;
};

// The brightest channel of the texels of a block; NaN where one is.
float brightest(const float* texels, int width, int height, int block, int column, int row) {
  float most = 0;
  for (int y = row * block; y < std::min(height, (row + 1) * block); ++y)
    for (int x = column * block; x < std::min(width, (column + 1) * block); ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = texels[(static_cast<std::size_t>(y) * width + x) * 4 + c];
        if (!(value <= most)) most = value;
      }
  return most;
}

// A block of one colour: the HDR void extent without coordinates, four halves (Khronos Data Format 1.3, 23.23).
void put_constant(const float* rgb, std::uint8_t* block) {
  constexpr std::array<std::uint8_t, 8> head = {0xFC, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
  std::copy(head.begin(), head.end(), block);
  std::size_t clipped = 0;
  for (int c = 0; c < 4; ++c) {
    const std::uint16_t code = half_saturated(c < 3 ? rgb[c] : 1.0f, clipped);
    block[8 + 2 * c] = static_cast<std::uint8_t>(code & 0xff);
    block[9 + 2 * c] = static_cast<std::uint8_t>(code >> 8);
  }
}

}  // namespace

struct AstcEncoder::State {
  struct Bad {
    int column, row;
    float brightest;
  };

  int block;
  Context context;

  State(int side, BlockQuality quality) : block(side), context(side, preset(quality), 0) {}

  std::vector<Bad> find_bad(const float* texels, int width, int height,
                            std::span<const std::uint8_t> blocks) {
    std::vector<float> decoded(static_cast<std::size_t>(width) * height * 4);
    context.decompress(blocks, width, height, decoded.data());
    std::vector<Bad> bad;
    for (int row = 0; row * block < height; ++row)
      for (int column = 0; column * block < width; ++column) {
        const float given = brightest(texels, width, height, block, column, row);
        const float made = brightest(decoded.data(), width, height, block, column, row);
        if (!(made <= overshoot * given + overshoot_at_zero)) bad.push_back({column, row, given});
      }
    return bad;
  }

  // The texels of bad blocks side by side, whole blocks, none above limit times the block's brightest.
  std::vector<float> gather(const float* texels, int width, int height, const std::vector<Bad>& bad,
                            float limit) const {
    const std::size_t stride = bad.size() * static_cast<std::size_t>(block);
    std::vector<float> strip(stride * static_cast<std::size_t>(block) * 4, 1.0f);
    for (std::size_t i = 0; i < bad.size(); ++i)
      for (int y = 0; y < block; ++y)
        for (int x = 0; x < block; ++x) {
          const int sx = std::min(width - 1, bad[i].column * block + x);
          const int sy = std::min(height - 1, bad[i].row * block + y);
          const float* from = texels + (static_cast<std::size_t>(sy) * width + sx) * 4;
          float* to =
              &strip[(static_cast<std::size_t>(y) * stride + i * static_cast<std::size_t>(block) + x) * 4];
          for (int c = 0; c < 3; ++c) to[c] = std::min(from[c], limit * bad[i].brightest);
        }
    return strip;
  }

  // The mean of the i-th block of a strip of `count`.
  std::array<float, 3> mean(const std::vector<float>& strip, std::size_t count, std::size_t i) const {
    const auto side = static_cast<std::size_t>(block);
    std::array<double, 3> sum{};
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          sum[c] += static_cast<double>(strip[((y * count + i) * side + x) * 4 + c]);
    std::array<float, 3> result{};
    for (std::size_t c = 0; c < 3; ++c)
      result[c] = static_cast<float>(sum[c] / static_cast<double>(side * side));
    return result;
  }

  // Encodes the bad blocks again and keeps what is within bounds; returns those that are still bad.
  std::vector<Bad> retry(const float* texels, int width, int height, std::vector<Bad> bad, float limit,
                         std::span<std::uint8_t> blocks) {
    std::vector<float> strip = gather(texels, width, height, bad, limit);
    const int strip_width = static_cast<int>(bad.size()) * block;
    std::vector<std::uint8_t> encoded(bad.size() * block_bytes);
    context.compress(strip.data(), strip_width, block, encoded);
    std::vector<float> decoded(strip.size());
    context.decompress(encoded, strip_width, block, decoded.data());
    std::vector<Bad> left;
    for (std::size_t i = 0; i < bad.size(); ++i) {
      const float made = brightest(decoded.data(), strip_width, block, block, static_cast<int>(i), 0);
      if (made <= overshoot * bad[i].brightest + overshoot_at_zero)
        std::copy_n(&encoded[i * block_bytes], block_bytes, place(blocks, width, bad[i]));
      else
        left.push_back(bad[i]);
    }
    return left;
  }

  std::uint8_t* place(std::span<std::uint8_t> blocks, int width, const Bad& bad) const {
    const std::size_t columns = static_cast<std::size_t>((width - 1) / block + 1);
    return &blocks[(static_cast<std::size_t>(bad.row) * columns + static_cast<std::size_t>(bad.column)) *
                   block_bytes];
  }
};

AstcEncoder::AstcEncoder(int block, BlockQuality quality) : state_(std::make_unique<State>(block, quality)) {}
AstcEncoder::~AstcEncoder() = default;

void AstcEncoder::encode(std::span<const float> texels, int width, int height,
                         std::span<std::uint8_t> blocks) {
  assert(texels.size() == static_cast<std::size_t>(width) * height * 4);
  std::vector<float> copy(texels.begin(), texels.end());  // astcenc wants pointers to what it does not change
  state_->context.compress(copy.data(), width, height, blocks);
  std::vector<State::Bad> bad = state_->find_bad(copy.data(), width, height, blocks);
  for (const float limit : limits) {
    if (bad.empty()) return;
    bad = state_->retry(copy.data(), width, height, std::move(bad), limit, blocks);
  }
  const std::vector<float> strip = state_->gather(copy.data(), width, height, bad, 1.0f);
  for (std::size_t i = 0; i < bad.size(); ++i)
    put_constant(state_->mean(strip, bad.size(), i).data(), state_->place(blocks, width, bad[i]));
}

struct AstcDecoder::State {
  int block;
  Context context;
};

AstcDecoder::AstcDecoder(int block)
    : state_(new State{block, Context(block, ASTCENC_PRE_FAST, ASTCENC_FLG_DECOMPRESS_ONLY)}) {}
AstcDecoder::~AstcDecoder() = default;

void AstcDecoder::decode(std::span<const std::uint8_t> blocks, int width, int height, std::span<float> texels,
                         std::string_view name) {
  assert(texels.size() == static_cast<std::size_t>(width) * height * 4);
  state_->context.decompress(blocks, width, height, texels.data());
  for (std::size_t i = 0; i < texels.size(); ++i)
    if (std::isnan(texels[i]))
      throw Error(name, "holds an ASTC block that is not valid in an HDR texture; the file is damaged");
}

}  // namespace welkin
