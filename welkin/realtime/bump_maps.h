#pragma once
#include <vector>

#include <welkin/scene/scene.h>

namespace welkin {

/// What a normal map looks like from far away: at every mip level the statistics of the normals under each texel, all levels averaged
/// straight from level 0. `slope` is s = (x / z, y / z) of a normal (x, y, z) in the tangent frame, so that n ~ (s, 1). Every average
/// can be filtered linearly, by texture hardware too.
struct BumpMaps {
  std::vector<Image> slopes;  ///< 4 channels: E[s_x], E[s_y], E[s_x s_x], E[s_y s_y] (Olano & Baker 2010)
  std::vector<Image> shapes;  ///< 4 channels: E[s_x s_y], 0, 0, 0
  std::vector<Image>
      normals;  ///< 3 channels: E[n] of unit normals, shorter than 1 where they differ (Toksvig 2005)
};

/// The statistics of a normal map as a material uses it: x and y of every texel's normal times `normal_scale`. Normals are
/// interpolated bilinearly between texels first, as every renderer does, and averaged over each texel's square at level 0 already
/// (four by four points, exact where slopes are bilinear); levels above average exactly, texels that are shared between two by their parts.
/// Normals flatter on the surface than slope 8 count as 8. Throws Error for an image that is empty or has less than 3 channels.
BumpMaps make_bump_maps(const Texture& texture, float normal_scale);

}  // namespace welkin
