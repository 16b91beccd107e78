#include <welkin/envmap/importance/quad_table.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/prefetch.h>

namespace welkin {
namespace {

constexpr float largest = 0x1.fffffep-1f;

// Goes to one of two sides and stretches u over it; returns whether to the second.
int descend(float first, float& u, float& probability) {
  const bool second = u >= first;
  const float share = second ? 1 - first : first;
  u = std::min((second ? u - first : u) / share, largest);
  probability *= share;
  return second;
}

float share_of(float a, float b) { return a + b > 0 ? a / (a + b) : 0; }

// Undoes descend.
float ascend(float first, int second, float u) { return second != 0 ? first + (1 - first) * u : first * u; }

}  // namespace

// The bits of a float from the exponent of 2^-32 on: 5 of exponent, 10 of mantissa; 0 is 0.
std::uint16_t encode_split(double first_share) {
  const bool large = first_share > 0.5;
  const double least = large ? 1 - first_share : first_share;
  if (least <= 0) return large ? 0x8000u : 0;
  const float share = static_cast<float>(std::clamp(least, 0x1p-24, 0.5));
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(share) + (1u << 12);
  const std::uint32_t code = std::min((bits >> 13) - (95u << 10), 31u << 10);
  return static_cast<std::uint16_t>(code | (large ? 0x8000u : 0));
}

float decode_split(std::uint16_t code) {
  const std::uint32_t low = code & 0x7fffu;
  const float share = low == 0 ? 0.0f : std::bit_cast<float>((low + (95u << 10)) << 13);
  return (code & 0x8000u) != 0 ? 1 - share : share;
}

namespace {

// Sums of 2 x 2 texels of a tile, 4 x 4 of them.
std::array<double, 16> block_sums(const TexelWeights& weights, int left, int top) {
  std::array<double, 16> sums{};
  for (int y = top; y < std::min(top + 8, weights.map.height); ++y)
    for (int x = left; x < std::min(left + 8, weights.map.width); ++x)
      sums[(y - top) / 2 * 4 + (x - left) / 2] += weights(x, y);
  return sums;
}

double fraction(double a, double b) { return a + b > 0 ? a / (a + b) : 0; }

// The three splits of a node with the children a b / c d.
void encode_node(double a, double b, double c, double d, std::uint16_t* out) {
  out[0] = encode_split(fraction(a + b, c + d));
  out[1] = encode_split(fraction(a, b));
  out[2] = encode_split(fraction(c, d));
}

}  // namespace

QuadTable::QuadTable(const TexelWeights& weights)
    : map_(&weights.map), tiles_wide_((weights.map.width + size - 1) / size) {
  const int tiles_high = (weights.map.height + size - 1) / size;
  // Of the leaves only ratios count: scaled so that four of them neither overflow nor vanish in a float.
  const float sum = weights.channels[0] + weights.channels[1] + weights.channels[2];
  for (int c = 0; c < 3; ++c) channels_[c] = weights.channels[c] / (8 * sum);
  const double highest = *std::max_element(weights.row_factor.begin(), weights.row_factor.end());
  for (double factor : weights.row_factor) row_factor_.push_back(static_cast<float>(factor / highest));
  splits_.resize(static_cast<std::size_t>(tiles_wide_) * tiles_high);
  std::vector<double> totals(splits_.size());
  parallel_for(splits_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto s = block_sums(weights, static_cast<int>(t % tiles_wide_) * size,
                                static_cast<int>(t / tiles_wide_) * size);
      std::array<double, 4> quarter{};
      for (int q = 0; q < 4; ++q) {
        const int at = q / 2 * 8 + q % 2 * 2;
        encode_node(s[at], s[at + 1], s[at + 4], s[at + 5], splits_[t].data() + 3 + 3 * q);
        quarter[q] = s[at] + s[at + 1] + s[at + 4] + s[at + 5];
      }
      encode_node(quarter[0], quarter[1], quarter[2], quarter[3], splits_[t].data());
      totals[t] = quarter[0] + quarter[1] + quarter[2] + quarter[3];
    }
  });
  tiles_ = InverseTable(tiles_wide_, tiles_high, totals);
}

float QuadTable::weight(int x, int y) const {
  if (x >= map_->width || y >= map_->height) return 0;
  const float* p = map_->at(x, y);
  return row_factor_[y] * (channels_[0] * p[0] + channels_[1] * p[1] + channels_[2] * p[2]);
}

// From a tile to the block of 2 x 2 texels in it, and to the block's texel.
void QuadTable::to_block(TexelChoice& choice) const {
  const Splits& table = splits(choice.x, choice.y);
  choice.within = {std::min(choice.within.x, largest), std::min(choice.within.y, largest)};
  for (int level = 0, node = 0; level < 2; ++level) {
    const int down = descend(decode_split(table[node]), choice.within.y, choice.probability);
    const int right = descend(decode_split(table[node + 1 + down]), choice.within.x, choice.probability);
    choice.x = 2 * choice.x + right;
    choice.y = 2 * choice.y + down;
    node = 3 + 3 * (2 * down + right);
  }
  choice.x *= 2;
  choice.y *= 2;
}

void QuadTable::to_texel(TexelChoice& choice) const {
  const int x = choice.x, y = choice.y;
  const float a = weight(x, y), b = weight(x + 1, y), c = weight(x, y + 1), d = weight(x + 1, y + 1);
  const int down = descend(share_of(a + b, c + d), choice.within.y, choice.probability);
  choice.x += descend(down != 0 ? share_of(c, d) : share_of(a, b), choice.within.x, choice.probability);
  choice.y += down;
}

TexelChoice QuadTable::choose(Vec2f u) const {
  TexelChoice choice = tiles_.choose(u);
  to_block(choice);
  to_texel(choice);
  return choice;
}

void QuadTable::choose(std::span<const Vec2f> u, TexelChoice* choices) const {
  const std::span<TexelChoice> all(choices, u.size());
  tiles_.choose(u, choices);
  for (const TexelChoice& choice : all) prefetch(splits(choice.x, choice.y).data());
  for (TexelChoice& choice : all) {
    to_block(choice);
    prefetch(map_->at(choice.x, choice.y));
    prefetch(map_->at(choice.x, std::min(choice.y + 1, map_->height - 1)));
  }
  for (TexelChoice& choice : all) to_texel(choice);
}

// The splits from the tile to a texel, rows and columns in turn, and which side was taken.
struct QuadTable::Path {
  std::array<float, 3> rows{}, columns{};
  std::array<int, 3> down{}, right{};
};

QuadTable::Path QuadTable::path(int x, int y) const {
  Path path;
  for (int level = 0; level < 3; ++level) {
    path.down[level] = (y >> (2 - level)) & 1;
    path.right[level] = (x >> (2 - level)) & 1;
  }
  const Splits& table = splits(x / size, y / size);
  for (int level = 0, node = 0; level < 2; ++level) {
    path.rows[level] = decode_split(table[node]);
    path.columns[level] = decode_split(table[node + 1 + path.down[level]]);
    node = 3 + 3 * (2 * path.down[level] + path.right[level]);
  }
  const int left = x & ~1, top = y & ~1;
  const float a = weight(left, top), b = weight(left + 1, top);
  const float c = weight(left, top + 1), d = weight(left + 1, top + 1);
  path.rows[2] = share_of(a + b, c + d);
  path.columns[2] = path.down[2] != 0 ? share_of(c, d) : share_of(a, b);
  return path;
}

float QuadTable::probability(int x, int y) const {
  float p = tiles_.probability(x / size, y / size);
  if (!(p > 0)) return 0;
  const Path path = this->path(x, y);
  for (int level = 0; level < 3; ++level) {
    p *= path.down[level] != 0 ? 1 - path.rows[level] : path.rows[level];
    p *= path.right[level] != 0 ? 1 - path.columns[level] : path.columns[level];
  }
  return p;
}

Vec2f QuadTable::invert(int x, int y, Vec2f within) const {
  const Path path = this->path(x, y);
  for (int level = 2; level >= 0; --level) {
    within.y = ascend(path.rows[level], path.down[level], within.y);
    within.x = ascend(path.columns[level], path.right[level], within.x);
  }
  return tiles_.invert(x / size, y / size, within);
}

}  // namespace welkin
