#pragma once
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// The mip chain of filter_quick: private to welkin/envmap/methods.

namespace welkin {

/// A cube's mip chain by quadratic B-splines, made for the cube as Manson & Sloan 2016 do: a coarse texel is the mean
/// of the 4 x 4 texels around it with weights 1 3 3 1 along each axis times solid angle, across edges too; in the
/// three corners of 12 texels. Look-ups are bilinear and seamless (the rules of look_up_cube).
class SplineMips {
 public:
  /// 3 channels.
  explicit SplineMips(const Cube& cube);

  /// The deviation (rad, along an axis) of the narrowest footprint: a look-up in level 0, mean over the sphere.
  double least_deviation() const;

  /// Adds weight times the look-up in a direction (any length > 0) whose footprint has the variance
  /// deviation^2 (rad^2) wherever on the cube it falls: two levels are blended. At least a level 0 texel.
  void add_look_up(Vec3 direction, double deviation, double weight, double* rgb) const;

 private:
  struct Level {
    int size = 0;
    std::vector<float>
        texels;  // 6 faces of (size + 2)^2 texels of 4 floats: a border of one texel around each

    float* at(int face, int x, int y) {  // -1 .. size
      return texels.data() + 4 * ((static_cast<std::size_t>(face) * (size + 2) + y + 1) * (size + 2) + x + 1);
    }
    const float* at(int face, int x, int y) const { return const_cast<Level*>(this)->at(face, x, y); }
    void fill_borders();
    void add_bilinear(int face, double s, double t, double weight, double* rgb) const;
  };
  static Level empty_level(int size);
  static Level halved(const Level& fine);

  std::vector<Level> levels_;
};

}  // namespace welkin
