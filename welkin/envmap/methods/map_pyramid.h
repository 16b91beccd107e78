#pragma once
#include <vector>

#include <welkin/envmap/patch_quadrature.h>
#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// A quadtree over an equirectangular map: node (level, x, y) covers the texels of 2^level columns and rows from
/// (x << level, y << level) on, as far as the map goes, and holds their mean radiance by solid angle. Level 0 is the map.
class MapPyramid {
 public:
  /// Keeps a reference to the map, 3 channels.
  explicit MapPyramid(const Image& equirect);

  int top() const { return static_cast<int>(levels_.size()) - 1; }  ///< this level is one node
  int columns(int level) const { return static_cast<int>(levels_[level].cos_phi.size()); }
  int rows(int level) const { return static_cast<int>(levels_[level].rows.size()); }

  const float* radiance(int level, int x, int y) const {
    return level == 0 ? map_.at(x, y) : levels_[level].means.at(x, y);
  }
  Vec3 direction(int level, int x, int y) const {
    const Level& at = levels_[level];
    const Row& row = at.rows[y];
    return {row.sin_theta * at.cos_phi[x], row.cos_theta, row.sin_theta * at.sin_phi[x]};
  }
  double solid_angle(int level, int x, int y) const {
    return levels_[level].rows[y].height_in_cos * levels_[level].width[x];
  }
  /// Half the longer side of a node, rad.
  double half_size(int level, int y) const { return levels_[level].rows[y].half_size; }
  SpherePatch patch(int level, int x, int y) const;

 private:
  struct Row {
    double sin_theta, cos_theta;
    double height_in_cos;  // cos theta0 - cos theta1
    double half_size;
  };
  struct Level {
    Image means;  // empty at level 0
    std::vector<Row> rows;
    std::vector<double> cos_phi, sin_phi, width;  // of the columns, rad
  };
  void lay_out(int level);
  Image halved(const Image& finer, int level) const;

  const Image& map_;
  std::vector<Level> levels_;
};

}  // namespace welkin
