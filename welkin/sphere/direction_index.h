#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <welkin/sphere/mapping.h>

namespace welkin {

/// The directions of all texels of a map, sorted into bins on a cube, for asking which texels lie near a direction
/// whatever the mapping: seams, poles, folds and face edges need no special care.
class DirectionIndex {
 public:
  struct Entry {
    float x, y, z;        ///< unit direction of the texel's centre
    float solid_angle;    ///< sr, > 0
    std::uint32_t texel;  ///< y * width + x
  };

  explicit DirectionIndex(MapShape shape);

  /// Calls visit(std::span<const Entry>) for runs of entries that include every texel within `radius` (an angle in
  /// radians) of a unit direction, and some beyond it, each once, in a fixed order.
  template <class Visit>
  void visit_near(Vec3 direction, double radius, Visit&& visit) const {
    for (int face = 0; face < 6; ++face) {
      const Range range = range_on_face(face, direction, radius);
      for (int t = range.t0; t <= range.t1; ++t) {
        const std::size_t row = (static_cast<std::size_t>(face) * bins_ + t) * bins_;
        const std::uint32_t begin = start_[row + range.s0], end = start_[row + range.s1 + 1];
        if (begin < end) visit(std::span<const Entry>(entries_.data() + begin, end - begin));
      }
    }
  }

 private:
  /// Bins s0..s1 x t0..t1 of a face; empty when t1 < t0.
  struct Range {
    int s0, s1, t0, t1;
  };
  Range range_on_face(int face, Vec3 direction, double radius) const;
  std::size_t bin_of(Vec3 direction) const;

  int bins_ = 1;
  std::vector<std::uint32_t> start_;  // 6 bins_^2 + 1 offsets into entries_
  std::vector<Entry> entries_;
};

}  // namespace welkin
