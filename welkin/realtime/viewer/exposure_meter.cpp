#include <welkin/realtime/viewer/exposure_meter.h>

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr int most_cells = 64;  // along a side; log_luminance.frag looks at 8 x 8 pixels of each
constexpr double middle_gray = 0.18;

}  // namespace

ExposureMeter::ExposureMeter() : program_("fullscreen.vert", "log_luminance.frag") {}

float ExposureMeter::measure(const RenderTarget& picture) {
  const int width = std::min(picture.width, most_cells), height = std::min(picture.height, most_cells);
  if (cells_.width != width || cells_.height != height) {
    const TexelFormat format = TexelFormat::rgba32f;
    cells_ = {};
    cells_ = make_render_target(width, height, &format, 1, false);
  }
  cells_.bind();
  glDisable(GL_DEPTH_TEST);
  program_.use();
  program_.set_texture("picture", 0, GL_TEXTURE_2D, picture.colors[0]);
  glUniform2i(glGetUniformLocation(program_.name(), "grid"), width, height);
  fullscreen_.draw();
  const Image cells = read_pixels(cells_);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < cells.pixels.size(); i += 4) {
    sum += cells.pixels[i];
    count += cells.pixels[i + 1];
  }
  return count == 0 ? 0.0f : static_cast<float>(std::log2(middle_gray) - sum / count);
}

}  // namespace welkin
