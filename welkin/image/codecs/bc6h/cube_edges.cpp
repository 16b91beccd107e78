#include <welkin/image/codecs/bc6h/cube_edges.h>

namespace welkin::bc6h {
namespace {

using Axis = std::array<int, 3>;

// The rays of docs/conventions.md: face + s along + t along.
struct Frame {
  Axis axis, s, t;
};
constexpr std::array<Frame, 6> frames = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                          {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                          {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                          {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                          {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                          {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

constexpr int dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

int face_of(const Axis& axis) {
  int face = 0;
  while (frames[static_cast<std::size_t>(face)].axis != axis) ++face;
  return face;
}

}  // namespace

CubeTexel on_side(int size, int face, int side, int along) {
  if (side < 2) return {face, side == 0 ? 0 : size - 1, along};
  return {face, along, side == 2 ? 0 : size - 1};
}

// In units of half a texel the cube reaches from -size to size and texel centres lie at 2 x + 1 - size. One step over the
// edge of face A towards face B, the component along A's axis is size - 1 and the one along the edge stays.
CubeTexel across_edge(int size, int face, int side, int along) {
  const Frame& from = frames[static_cast<std::size_t>(face)];
  const Axis& outwards = side < 2 ? from.s : from.t;
  const Axis& edge = side < 2 ? from.t : from.s;
  const int sign = side % 2 == 0 ? -1 : 1;
  Axis towards{}, point{};
  for (std::size_t i = 0; i < 3; ++i) {
    towards[i] = sign * outwards[i];
    point[i] = (size - 1) * from.axis[i] + (2 * along + 1 - size) * edge[i];
  }
  const int other = face_of(towards);
  const Frame& to = frames[static_cast<std::size_t>(other)];
  return {other, (dot(point, to.s) + size - 1) / 2, (dot(point, to.t) + size - 1) / 2};
}

int side_towards(CubeTexel texel, int from_face, int size) {
  for (int side = 0; side < side_count; ++side) {
    if (across_edge(size, texel.face, side, 0).face == from_face) return side;
  }
  return 0;
}

}  // namespace welkin::bc6h
