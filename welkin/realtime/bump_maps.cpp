#include <welkin/realtime/bump_maps.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr int channels = 8;  // s_x, s_y, s_x s_x, s_y s_y, s_x s_y, n_x, n_y, n_z
constexpr double steepest = 8;

int wrapped(int i, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == TextureWrap::repeat ? size : 2 * size;
  const int inside = ((i % period) + period) % period;
  return inside < size ? inside : period - 1 - inside;
}

// Both texels and the second one's weight, for a point `offset` from texel i's centre, in texels.
struct Between {
  int first, second;
  double weight;
};

Between between(int i, double offset, int size, TextureWrap wrap, bool nearest) {
  if (nearest) return {i, i, 0};
  return offset < 0 ? Between{wrapped(i - 1, size, wrap), i, 1 + offset}
                    : Between{i, wrapped(i + 1, size, wrap), offset};
}

// What one interpolated normal (not of unit length) adds to the sums.
void add_normal(double x, double y, double z, double weight, double* sums) {
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 1e-6)) {
    sums[7] += weight;
    return;
  }
  const double flat = std::hypot(x, y), height = std::max(z, flat / steepest);
  const double sx = x / height, sy = y / height;
  const double values[channels] = {sx, sy, sx * sx, sy * sy, sx * sy, x / length, y / length, z / length};
  for (int c = 0; c < channels; ++c) sums[c] += weight * values[c];
}

// Gauss's two points in each half of a texel: between texel centres normals are bilinear there, and the products of two slopes biquadratic.
constexpr double near_point = 0.25 - 0.14433756729740643, far_point = 0.25 + 0.14433756729740643;
constexpr double points[4] = {-far_point, -near_point, near_point, far_point};

void average_texel(const Texture& texture, double scale, int column, int row, float* out) {
  const Image& image = texture.image;
  double sums[channels] = {};
  for (const double down : points) {
    const Between v = between(row, down, image.height, texture.wrap_v, texture.nearest);
    for (const double right : points) {
      const Between u = between(column, right, image.width, texture.wrap_u, texture.nearest);
      double n[3];
      for (int c = 0; c < 3; ++c) {
        const auto texel = [&](int x, int y) { return 2.0 * image.at(x, y)[c] - 1; };
        const double above =
            texel(u.first, v.first) + u.weight * (texel(u.second, v.first) - texel(u.first, v.first));
        const double below =
            texel(u.first, v.second) + u.weight * (texel(u.second, v.second) - texel(u.first, v.second));
        n[c] = above + v.weight * (below - above);
      }
      add_normal(scale * n[0], scale * n[1], n[2], 1.0 / 16, sums);
    }
  }
  for (int c = 0; c < channels; ++c) out[c] = static_cast<float>(sums[c]);
}

Image average_of_texels(const Texture& texture, double scale) {
  Image level(texture.image.width, texture.image.height, channels);
  parallel_for(static_cast<std::size_t>(level.height), 8, [&](std::size_t begin, std::size_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row)
      for (int column = 0; column < level.width; ++column)
        average_texel(texture, scale, column, row, level.at(column, row));
  });
  return level;
}

// One row or column of the next level: texel i covers [i, i + 1) * fine / coarse texels of the finer one.
struct Share {
  int first = 0;
  std::vector<double> weights;  // sum 1
};

std::vector<Share> shares(int fine, int coarse) {
  std::vector<Share> all(static_cast<std::size_t>(coarse));
  const double ratio = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    const double low = i * ratio, high = (i + 1) * ratio;
    Share& share = all[static_cast<std::size_t>(i)];
    share.first = static_cast<int>(low);
    for (int j = share.first; j < fine && j < high - 1e-9; ++j)
      share.weights.push_back((std::min(high, j + 1.0) - std::max(low, static_cast<double>(j))) / ratio);
  }
  return all;
}

void average_shares(const Image& fine, const Share& column, const Share& row, float* out) {
  double sums[channels] = {};
  for (std::size_t j = 0; j < row.weights.size(); ++j) {
    for (std::size_t i = 0; i < column.weights.size(); ++i) {
      const float* texel = fine.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
      for (int c = 0; c < channels; ++c) sums[c] += row.weights[j] * column.weights[i] * texel[c];
    }
  }
  std::transform(sums, sums + channels, out, [](double sum) { return static_cast<float>(sum); });
}

Image next_level(const Image& fine) {
  Image coarse(std::max(1, fine.width / 2), std::max(1, fine.height / 2), channels);
  const auto columns = shares(fine.width, coarse.width), rows = shares(fine.height, coarse.height);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x)
      average_shares(fine, columns[static_cast<std::size_t>(x)], rows[static_cast<std::size_t>(y)],
                     coarse.at(x, y));
  return coarse;
}

Image pick(const Image& all, int first, int count, int wanted) {
  Image picked(all.width, all.height, wanted);
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x) std::copy_n(all.at(x, y) + first, count, picked.at(x, y));
  return picked;
}

}  // namespace

BumpMaps make_bump_maps(const Texture& texture, float normal_scale) {
  if (texture.image.empty() || texture.image.channels < 3)
    throw Error("texture " + texture.name, "is no normal map: it needs three channels");
  BumpMaps maps;
  Image level = average_of_texels(texture, normal_scale);
  for (;;) {
    maps.slopes.push_back(pick(level, 0, 4, 4));
    maps.shapes.push_back(pick(level, 4, 1, 4));
    maps.normals.push_back(pick(level, 5, 3, 3));
    if (level.width == 1 && level.height == 1) return maps;
    level = next_level(level);
  }
}

}  // namespace welkin
