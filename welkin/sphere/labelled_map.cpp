#include <welkin/sphere/labelled_map.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

// 5 x 7 letters, one row per entry from the top, the highest of five bits at the left.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;
};
constexpr Glyph glyphs[] = {{'N', {0b10001, 0b11001, 0b11101, 0b10111, 0b10011, 0b10001, 0b10001}},
                            {'E', {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111}},
                            {'S', {0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110}},
                            {'W', {0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001}},
                            {'U', {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110}},
                            {'P', {0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000}},
                            {'D', {0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110}},
                            {'O', {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110}}};
constexpr std::string_view words[6] = {"E", "W", "UP", "DOWN", "S", "N"};

bool glyph_ink(char letter, int column, int row) {
  for (const Glyph& glyph : glyphs) {
    if (glyph.letter == letter) return ((glyph.rows[static_cast<std::size_t>(row)] >> (4 - column)) & 1) != 0;
  }
  return false;
}

// Whether (right, up), in [-1, 1] across a face seen from the inside, meets a word in the middle of the face. Letters
// are 5 cells wide with one cell between them.
bool word_ink(std::string_view word, double right, double up) {
  const int columns = static_cast<int>(word.size()) * 6 - 1;
  const double cell = std::min(1.2 / columns, 1.2 / 7);
  const double x = right / cell + columns / 2.0, y = 3.5 - up / cell;
  if (x < 0 || x >= columns || y < 0 || y >= 7) return false;
  const int column = static_cast<int>(x);
  if (column % 6 == 5) return false;
  return glyph_ink(word[static_cast<std::size_t>(column / 6)], column % 6, static_cast<int>(y));
}

}  // namespace

Label label_at(Vec3 direction) {
  const int face = cube_point(direction).face;
  const double axis = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const Vec3 p = (1 / axis) * direction;
  const double right[6] = {p.z, -p.z, p.x, p.x, -p.x, p.x};
  const double up[6] = {p.y, p.y, p.z, -p.z, p.y, p.y};
  return {face, word_ink(words[face], right[face], up[face])};
}

std::array<float, 3> label_radiance(Label label) {
  constexpr std::array<float, 3> faces[6] = {{0.8f, 0.05f, 0.05f}, {0.02f, 0.5f, 0.5f},  {0.05f, 0.1f, 0.8f},
                                             {0.6f, 0.5f, 0.02f},  {0.05f, 0.6f, 0.05f}, {0.6f, 0.05f, 0.5f}};
  return label.ink ? std::array<float, 3>{1, 1, 1} : faces[label.face];
}

SphereMap labelled_map(MapShape shape) {
  SphereMap map = make_sphere_map(shape);
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      if (!map_covers(shape, x, y) && map_texel_solid_angle(shape, x, y) <= 0) continue;
      const auto radiance = label_radiance(label_at(map_texel_direction(shape, x, y)));
      std::copy(radiance.begin(), radiance.end(), map.image.at(x, y));
    }
  }
  return map;
}

}  // namespace welkin
