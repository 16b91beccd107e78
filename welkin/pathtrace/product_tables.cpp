#include <welkin/pathtrace/product_tables.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/geometry/fast_angles.h>
#include <welkin/image/rgb.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/discrete.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr int most_columns = 128, most_rows = 64;  // of tiles: 2.8 degrees

std::vector<int> edges(int count, int parts) {
  std::vector<int> result(parts + 1);
  for (int i = 0; i <= parts; ++i) result[i] = static_cast<int>(static_cast<std::int64_t>(count) * i / parts);
  return result;
}

std::vector<std::uint16_t> parts_of(const std::vector<int>& edge) {
  std::vector<std::uint16_t> result;
  for (std::size_t i = 0; i + 1 < edge.size(); ++i)
    result.insert(result.end(), static_cast<std::size_t>(edge[i + 1] - edge[i]),
                  static_cast<std::uint16_t>(i));
  return result;
}

Vec3f to_float(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

constexpr float largest = 0x1.fffffep-1f;

// Picks from a CDF and stretches u over the step.
std::size_t pick(const float* cdf, std::size_t count, float& u, float& probability) {
  const std::size_t i = last_not_above(cdf, count, u);
  probability = cdf[i + 1] - cdf[i];
  u = std::min((u - cdf[i]) / probability, largest);
  return i;
}

}  // namespace

TiledMap::TiledMap(const Image& map)
    : width_(map.width),
      height_(map.height),
      columns_(std::min(map.width, most_columns)),
      rows_(std::min(map.height, most_rows)),
      left_(edges(map.width, columns_)),
      top_(edges(map.height, rows_)),
      first_(static_cast<std::size_t>(columns_) * rows_ + 1),
      energy_(first_.size() - 1),
      moment_(first_.size() - 1) {
  column_of_ = parts_of(left_);
  row_of_ = parts_of(top_);
  for (int tile = 0; tile < columns_ * rows_; ++tile) {
    const int i = tile % columns_, j = tile / columns_;
    first_[tile + 1] =
        first_[tile] + static_cast<std::size_t>(left_[i + 1] - left_[i]) * (top_[j + 1] - top_[j]) + 1;
  }
  cdf_.resize(first_.back());
  parallel_for(energy_.size(), 64, [&](std::size_t begin, std::size_t end) {
    std::vector<double> weights;
    for (std::size_t tile = begin; tile < end; ++tile) {
      const int i = static_cast<int>(tile) % columns_, j = static_cast<int>(tile) / columns_;
      weights.clear();
      Vec3 moment;
      for (int y = top_[j]; y < top_[j + 1]; ++y) {
        const double solid_angle = equirect_texel_solid_angle(width_, height_, y);
        for (int x = left_[i]; x < left_[i + 1]; ++x) {
          const float* p = map.at(x, y);
          const double weight = solid_angle * (0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]);
          weights.push_back(weight);
          energy_[tile] += weight;
          moment = moment + weight * equirect_direction({(x + 0.5) / width_, (y + 0.5) / height_});
        }
      }
      quantised_cdf(weights.data(), weights.size(), cdf_.data() + first_[tile]);
      moment_[tile] = to_float(moment);
    }
  });
}

TiledMap::Texel TiledMap::choose(int tile, Vec2f u) const {
  const int i = tile % columns_, j = tile / columns_, wide = left_[i + 1] - left_[i];
  Texel texel;
  const int k = static_cast<int>(
      pick(cdf_.data() + first_[tile], first_[tile + 1] - first_[tile] - 1, u.x, texel.probability));
  texel.x = left_[i] + k % wide;
  texel.y = top_[j] + k / wide;
  texel.within = u;
  return texel;
}

float TiledMap::probability(int x, int y) const {
  const int i = column_of_[x], j = row_of_[y];
  const float* cdf = cdf_.data() + first_[static_cast<std::size_t>(j) * columns_ + i] +
                     static_cast<std::size_t>(y - top_[j]) * (left_[i + 1] - left_[i]) + (x - left_[i]);
  return cdf[1] - cdf[0];
}

TileBins::TileBins(const TiledMap& map, int shift)
    : columns_((map.columns() + (1 << shift) - 1) >> shift),
      rows_((map.rows() + (1 << shift) - 1) >> shift),
      shift_(shift),
      tile_columns_(map.columns()),
      tile_rows_(map.rows()),
      energy_(static_cast<std::size_t>(columns_) * rows_),
      centre_(energy_.size()),
      cdf_(energy_.size() * ((std::size_t{1} << 2 * shift) + 1)) {
  const int across = 1 << shift, count = across * across;
  for (int bin = 0; bin < columns_ * rows_; ++bin) {
    const int i0 = bin % columns_ * across, j0 = bin / columns_ * across;
    std::vector<double> weights(count);
    Vec3f moment{0, 0, 0};
    for (int k = 0; k < count; ++k) {
      const int i = i0 + k % across, j = j0 + k / across;
      if (i >= tile_columns_ || j >= tile_rows_) continue;
      weights[k] = map.energy(j * tile_columns_ + i);
      energy_[bin] += weights[k];
      moment = moment + map.moment(j * tile_columns_ + i);
    }
    quantised_cdf(weights.data(), weights.size(), cdf_.data() + static_cast<std::size_t>(bin) * (count + 1));
    const Vec3f middle = to_float(equirect_direction(
        {(i0 + 0.5 * across) / tile_columns_, std::min(1.0, (j0 + 0.5 * across) / tile_rows_)}));
    centre_[bin] = length(moment) > 1e-20f ? normalized(moment) : middle;
  }
}

int TileBins::choose(int bin, float& u, float& probability) const {
  const int across = 1 << shift_, count = across * across;
  probability = 1;
  int k = 0;
  if (shift_ > 0)
    k = static_cast<int>(
        pick(cdf_.data() + static_cast<std::size_t>(bin) * (count + 1), count, u, probability));
  return (bin / columns_ * across + k / across) * tile_columns_ + bin % columns_ * across + k % across;
}

float TileBins::probability(int tile_column, int tile_row) const {
  if (shift_ == 0) return 1;
  const int across = 1 << shift_, count = across * across, mask = across - 1;
  const std::size_t bin = static_cast<std::size_t>(tile_row >> shift_) * columns_ + (tile_column >> shift_);
  const float* cdf = cdf_.data() + bin * (count + 1) + (tile_row & mask) * across + (tile_column & mask);
  return cdf[1] - cdf[0];
}

namespace {

// The lobe for an angle of this cosine, 1 at its peak. GGX: D at half the angle (Walter et al. 2007), as if normal, view and
// reflection were one (Karis 2013). The cosine: a little light from behind its horizon, where a bin's other half may be.
float lobe_value(float alpha, float cosine) {
  if (alpha <= 0) return std::max(0.0f, (cosine + 0.05f) / 1.05f);
  const float squared = alpha * alpha;
  const float d = squared / (0.5f * (1 + cosine) * (squared - 1) + 1);
  return d * d;
}

// Beyond this angle from the axis the lobe is left to the samples of the BRDF.
float lobe_reach(float alpha) { return alpha <= 0 ? 1.65f : std::min(5 * alpha, 1.65f); }

// The window of bins that a cap of radius `reach` about the direction (theta, phi) touches.
LobeTable::Cell window(const TileBins& bins, double theta, double phi, double reach) {
  const double pi = std::numbers::pi;
  const double row_step = pi / bins.rows(), column_step = 2 * pi / bins.columns();
  LobeTable::Cell cell;
  const int top = std::max(0, static_cast<int>(std::floor((theta - reach) / row_step)));
  const int bottom = std::min(bins.rows() - 1, static_cast<int>(std::floor((theta + reach) / row_step)));
  cell.top = static_cast<std::uint16_t>(top);
  cell.height = static_cast<std::uint16_t>(bottom - top + 1);
  cell.width = static_cast<std::uint16_t>(bins.columns());
  if (reach < std::min(theta, pi - theta) && reach < pi / 2) {
    const double half = std::asin(std::min(1.0, std::sin(reach) / std::sin(theta)));
    const int left = static_cast<int>(std::floor((phi - half + pi) / column_step));
    const int right = static_cast<int>(std::floor((phi + half + pi) / column_step));
    cell.width = static_cast<std::uint16_t>(std::min(right - left + 1, bins.columns()));
    cell.left = static_cast<std::uint16_t>((left + bins.columns()) % bins.columns());
  }
  return cell;
}

}  // namespace

LobeTable::LobeTable(const TileBins& bins, float alpha)
    : bins_(&bins),
      columns_(std::max(1, bins.columns() / 2)),
      rows_(std::max(1, bins.rows() / 2)),
      cells_(static_cast<std::size_t>(columns_) * rows_) {
  const auto theta_of = [&](std::size_t k) {
    return std::numbers::pi * (static_cast<double>(k / columns_) + 0.5) / rows_;
  };
  const auto phi_of = [&](std::size_t k) {
    return 2 * std::numbers::pi * ((static_cast<double>(k % columns_) + 0.5) / columns_ - 0.5);
  };
  std::size_t total = 0;
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    cells_[k] = window(bins, theta_of(k), phi_of(k), lobe_reach(alpha));
    cells_[k].first = static_cast<std::uint32_t>(total);
    total += static_cast<std::size_t>(cells_[k].width) * cells_[k].height + 1;
  }
  cdf_.resize(total);
  double norm = 0;  // the lobe's integral, over cos in [-1, 1]
  for (int i = 0; i < 4096; ++i) norm += lobe_value(alpha, -1 + (static_cast<float>(i) + 0.5f) / 2048) / 2048;
  parallel_for(cells_.size(), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<double> weights;
    for (std::size_t k = begin; k < end; ++k) {
      Cell& cell = cells_[k];
      const double theta = theta_of(k), phi = phi_of(k);
      const Vec3f axis =
          to_float({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
      weights.clear();
      double sum = 0;
      for (int j = 0; j < cell.height; ++j)
        for (int i = 0; i < cell.width; ++i) {
          const int bin = (cell.top + j) * bins.columns() + (cell.left + i) % bins.columns();
          weights.push_back(bins.energy(bin) * lobe_value(alpha, dot(axis, bins.centre(bin))));
          sum += weights.back();
        }
      quantised_cdf(weights.data(), weights.size(), cdf_.data() + cell.first);
      cell.mass = static_cast<float>(sum / (2 * std::numbers::pi * norm));
    }
  });
}

const LobeTable::Cell& LobeTable::cell_of(Vec3f axis) const {
  const float across = std::sqrt(axis.x * axis.x + axis.z * axis.z);
  const int i = static_cast<int>((atan2_turns(axis.z, axis.x) + 0.5f) * static_cast<float>(columns_));
  const int j = static_cast<int>(2 * atan2_turns(across, axis.y) * static_cast<float>(rows_));
  return cells_[static_cast<std::size_t>(std::min(j, rows_ - 1)) * columns_ + std::min(i, columns_ - 1)];
}

int LobeTable::choose(const Cell& cell, float& u, float& probability) const {
  const int k = static_cast<int>(
      pick(cdf_.data() + cell.first, static_cast<std::size_t>(cell.width) * cell.height, u, probability));
  int column = cell.left + k % cell.width;
  if (column >= bins_->columns()) column -= bins_->columns();
  return (cell.top + k / cell.width) * bins_->columns() + column;
}

float LobeTable::probability(const Cell& cell, int bin_column, int bin_row) const {
  int i = bin_column - cell.left;
  if (i < 0) i += bins_->columns();
  const int j = bin_row - cell.top;
  if (i >= cell.width || j < 0 || j >= cell.height) return 0;
  const float* cdf = cdf_.data() + cell.first + j * cell.width + i;
  return cdf[1] - cdf[0];
}

}  // namespace welkin
