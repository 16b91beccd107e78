#include <welkin/sphere/texel_weights.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double kernel_radius = 1.7;  // in units of the source's spacing

// The widest distance (radians) between neighbouring texel centres around a direction, made smooth where the exact
// figure has kinks (face edges, folds, the rim), because the width of the interpolation kernel follows it.
double map_spacing(MapShape shape, Vec3 d) {
  const double n = shape.height;
  switch (shape.mapping) {
    case Mapping::equirectangular: return std::numbers::pi * std::max(1.0 / shape.height, 2.0 / shape.width);
    case Mapping::cube: {
      const double x2 = d.x * d.x, y2 = d.y * d.y, z2 = d.z * d.z;
      const double sum8 = x2 * x2 * x2 * x2 + y2 * y2 * y2 * y2 + z2 * z2 * z2 * z2;
      const double root8 = std::sqrt(std::sqrt(std::sqrt(sum8)));
      return 2.0 / shape.width * root8 * std::sqrt(root8);  // (x^8 + y^8 + z^8)^(3/16)
    }
    case Mapping::dual_paraboloid: return 2 / n * (1 + std::sqrt(d.z * d.z + 0.01));
    case Mapping::mirror_ball: return 4 / n / std::sqrt((1 + d.z) / 2 + 1 / n);
    default: {
      const auto soft = [](double v) { return std::sqrt(v * v + 0.01); };
      return 2 / n * std::pow(soft(d.x) + soft(d.y) + soft(d.z), 1.5);
    }
  }
}

// None of the interpolation while the target's texels are wider than 4/5 of the source's, all of it from twice as fine
// up.
double share_of(const MapSource& source, MapShape target, Vec3 direction) {
  const double ratio =
      map_spacing(source.shape, source.from_target * direction) / map_spacing(target, direction);
  const double t = std::clamp((ratio - 1.25) / 0.75, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The same kernel as EquirectNeighbours::append, by the sorted directions.
double append_from_index(const DirectionIndex& index, int width, Vec3 direction, double radius,
                         std::vector<TexelWeight>& weights) {
  const float scale = static_cast<float>(1 / (radius * radius));
  const float dx = static_cast<float>(direction.x), dy = static_cast<float>(direction.y),
              dz = static_cast<float>(direction.z);
  double total = 0;
  index.visit_near(direction, radius, [&](std::span<const DirectionIndex::Entry> entries) {
    for (const DirectionIndex::Entry& e : entries) {
      const float x = e.x - dx, y = e.y - dy, z = e.z - dz;
      const float rest = 1 - scale * (x * x + y * y + z * z);
      if (rest <= 0) continue;
      const double weight = static_cast<double>(rest * rest * rest * e.solid_angle);
      const int texel = static_cast<int>(e.texel);
      weights.push_back({texel % width, texel / width, weight});
      total += weight;
    }
  });
  return total;
}

}  // namespace

ResampleGeometry::ResampleGeometry(const MapSource& source, MapShape target, bool interpolate)
    : source_(source), target_(target), density_(source.shape), interpolate_(interpolate) {
  if (interpolate_ && source.shape.mapping == Mapping::equirectangular) {
    neighbours_.emplace(source.shape);
  } else if (interpolate_ && any_magnified()) {
    index_.emplace(source.shape);
  } else {
    interpolate_ = false;
  }
}

bool ResampleGeometry::any_magnified() const {
  for (int y = 0; y < target_.height; ++y) {
    for (int x = 0; x < target_.width; x += std::max(1, target_.width / 64)) {
      if (smooth_share(map_texel_direction(target_, x, y)) > 0) return true;
    }
  }
  return false;
}

double ResampleGeometry::smooth_share(Vec3 direction) const {
  return interpolate_ ? share_of(source_, target_, direction) : 0;
}

double ResampleGeometry::append_smooth(Vec3 direction, std::vector<TexelWeight>& weights) const {
  const Vec3 wanted = source_.from_target * direction;
  const double radius = kernel_radius * map_spacing(source_.shape, wanted);
  if (neighbours_) return neighbours_->append(wanted, radius, weights);
  return append_from_index(*index_, source_.shape.width, wanted, radius, weights);
}

TexelWeights::TexelWeights(const ResampleGeometry& geometry, int columns)
    : geometry_(geometry), patch_mean_(geometry.source(), geometry.density(), geometry.target(), columns) {}

std::span<const TexelWeight> TexelWeights::operator()(int x, int y) {
  const Vec3 direction = map_texel_direction(geometry_.target(), x, y);
  const double share = geometry_.smooth_share(direction);
  if (share <= 0) return patch_mean_(x, y);
  weights_.clear();
  const double total = geometry_.append_smooth(direction, weights_);
  if (!(total > 0)) return patch_mean_(x, y);
  for (TexelWeight& w : weights_) w.weight *= share / total;
  if (share < 1) {
    for (const TexelWeight& w : patch_mean_(x, y)) weights_.push_back({w.x, w.y, (1 - share) * w.weight});
  }
  return weights_;
}

}  // namespace welkin
