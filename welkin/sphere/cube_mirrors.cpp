// The 16 mirrors that change the signs of x, y and z and swap x and z turn the cube's texels into each other, and, as
// they turn the longitude phi into pi - phi, -phi and pi/2 - phi and the colatitude into pi - theta, also the texels of
// an equirectangular map of W columns, W a multiple of 4, and H rows:
//   x -> -x: column i becomes 3 W/2 - 1 - i     y -> -y: row j becomes H - 1 - j
//   z -> -z: column i becomes W - 1 - i         x <-> z: column i becomes 5 W/4 - 1 - i, all modulo W.
// A target texel's weights follow from directions alone, so its mirror image has the same weights on the mirrored
// texels of the source. The cube is made of the images of a quarter of face +X and of an eighth of face +Y. A texel on a
// mirror plane is made twice, by the same thread, and the later one stays.
#include <welkin/sphere/cube_mirrors.h>

#include <array>
#include <cstdint>
#include <vector>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

// One of the 8 mirrors that leave y as it is; applied together with and without y -> -y.
struct Mirror {
  bool swap = false;
  double sign_x = 1, sign_z = 1;
  std::vector<std::uint32_t> columns;  // where column i of the source goes, times the channels

  Vec3 operator()(Vec3 d) const {
    return swap ? Vec3{sign_x * d.z, d.y, sign_z * d.x} : Vec3{sign_x * d.x, d.y, sign_z * d.z};
  }
};

Mirror make_mirror(int k, int width, int channels) {
  Mirror mirror{(k & 1) != 0, (k & 2) != 0 ? -1.0 : 1.0, (k & 4) != 0 ? -1.0 : 1.0, {}};
  for (std::int64_t i = 0; i < width; ++i) {
    std::int64_t column = i;
    if (mirror.swap) column = std::int64_t{5} * (width / 4) - 1 - column;
    if (mirror.sign_x < 0) column = std::int64_t{3} * (width / 2) - 1 - column;
    if (mirror.sign_z < 0) column = width - 1 - column;
    column = (column + 2 * std::int64_t{width}) % width;
    mirror.columns.push_back(static_cast<std::uint32_t>(column * channels));
  }
  return mirror;
}

using Mirrors = std::array<Mirror, 8>;

// The texel of the cube that shows a texel centre's direction.
float* texel_of(SphereMap& cube, Vec3 direction) {
  const CubePoint p = cube_point(direction);
  const int n = cube.image.width;
  const int x = static_cast<int>((p.s + 1) / 2 * n), y = static_cast<int>((p.t + 1) / 2 * n);
  return cube.image.at(x, p.face * n + y);
}

// Sums over the mirrored texels, with y as it is and mirrored at once: two independent chains of additions.
template <int channels>
void sum_mirrored(std::span<const TexelWeight> weights, const MapSource& source, const Mirror& mirror,
                  float* upper_out, float* lower_out) {
  const std::size_t row = static_cast<std::size_t>(source.shape.width) * channels;
  double upper[channels] = {}, lower[channels] = {};
  for (const TexelWeight& w : weights) {
    const std::uint32_t column = mirror.columns[static_cast<std::size_t>(w.x)];
    const float* a = source.pixels + static_cast<std::size_t>(w.y) * row + column;
    const float* b = source.pixels + static_cast<std::size_t>(source.shape.height - 1 - w.y) * row + column;
    for (int c = 0; c < channels; ++c) {
      upper[c] += w.weight * a[c];
      lower[c] += w.weight * b[c];
    }
  }
  for (int c = 0; c < channels; ++c) {
    upper_out[c] = static_cast<float>(upper[c]);
    lower_out[c] = static_cast<float>(lower[c]);
  }
}

void write_images(std::span<const TexelWeight> weights, const MapSource& source, const Mirrors& mirrors,
                  Vec3 direction, SphereMap& result) {
  for (const Mirror& mirror : mirrors) {
    const Vec3 image = mirror(direction);
    float* upper = texel_of(result, image);
    float* lower = texel_of(result, {image.x, -image.y, image.z});
    switch (source.channels) {
      case 1: sum_mirrored<1>(weights, source, mirror, upper, lower); break;
      case 2: sum_mirrored<2>(weights, source, mirror, upper, lower); break;
      case 3: sum_mirrored<3>(weights, source, mirror, upper, lower); break;
      default: sum_mirrored<4>(weights, source, mirror, upper, lower); break;
    }
  }
}

}  // namespace

bool has_mirrors(MapShape source, MapShape target) {
  return source.mapping == Mapping::equirectangular && source.width % 4 == 0 &&
         target.mapping == Mapping::cube;
}

void resample_mirrored(const ResampleGeometry& geometry, SphereMap& result) {
  const MapSource& source = geometry.source();
  const MapShape target = geometry.target();
  Mirrors mirrors;
  for (int k = 0; k < 8; ++k)
    mirrors[static_cast<std::size_t>(k)] = make_mirror(k, source.shape.width, source.channels);
  const int half = (target.width + 1) / 2;
  parallel_for(std::size_t{2} * static_cast<std::size_t>(half), 4, [&](std::size_t begin, std::size_t end) {
    TexelWeights weights(geometry, half);
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const bool side = row < half;
      const int y = side ? row : 2 * target.width + row - half;
      for (int x = 0; x < (side ? half : row - half + 1); ++x)
        write_images(weights(x, y), source, mirrors, map_texel_direction(target, x, y), result);
    }
  });
}

}  // namespace welkin
