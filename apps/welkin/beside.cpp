#include "beside.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "picture.h"

#include <welkin/image/codecs/ldr.h>
#include <welkin/image/tonemap.h>
#include <welkin/sphere/cube_layout.h>

namespace welkin {
namespace {

constexpr int margin = 8, caption_height = text_height + 2 * margin;

// Small cubes are shown with every texel as a block.
int block_size(int cube_size) { return cube_size >= 64 ? 1 : (64 + cube_size - 1) / cube_size; }

ByteImage enlarged(const ByteImage& source, int factor) {
  ByteImage result(source.width * factor, source.height * factor, source.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < result.channels; ++c) result.at(x, y)[c] = source.at(x / factor, y / factor)[c];
  return result;
}

Cube difference_of(const Cube& a, const Cube& b) {
  Cube difference(a.size);
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    difference.texels[i] = difference_gain * std::abs(a.texels[i] - b.texels[i]);
  return difference;
}

}  // namespace

std::vector<std::uint8_t> draw_beside(const Cube& truth, const Cube& result, const std::string& caption) {
  assert(truth.size == result.size && truth.channels == 3 && result.channels == 3);
  const Cube difference = difference_of(truth, result);
  const Cube* cubes[] = {&truth, &result, &difference};
  const std::string captions[] = {"truth", caption, fmt::format("difference * {:g}", difference_gain)};
  const int factor = block_size(truth.size), width = 4 * truth.size * factor,
            height = 3 * truth.size * factor;
  ByteImage sheet(3 * width + 4 * margin, height + caption_height + margin, 3);
  ToneMapOptions tone;
  tone.exposure_ev = automatic_exposure_ev(cube_to_layout(truth, CubeLayout::horizontal_strip));
  for (int i = 0; i < 3; ++i) {
    const ByteImage cross = tone_map(cube_to_layout(*cubes[i], CubeLayout::horizontal_cross), tone);
    const int x = margin + i * (width + margin);
    blit(enlarged(cross, factor), sheet, x, caption_height);
    draw_text(sheet, x, margin, 1, captions[i], {230, 230, 230});
  }
  return encode_png(sheet);
}

}  // namespace welkin
