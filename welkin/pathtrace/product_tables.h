#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include <welkin/geometry/vec3f.h>
#include <welkin/image/image.h>

// What ProductSampler looks up: the map cut into tiles, tiles gathered to bins, bins weighted by lobes.

namespace welkin {

/// The texels of a map by tiles, each tile with a CDF over its texels by luminance times solid angle.
class TiledMap {
 public:
  explicit TiledMap(const Image& map);

  struct Texel {
    int x = 0, y = 0;
    Vec2f within;           ///< in [0, 1)^2
    float probability = 0;  ///< within its tile
  };
  Texel choose(int tile, Vec2f u) const;
  float probability(int x, int y) const;  ///< within its tile

  int tile_column(int x) const { return column_of_[x]; }
  int tile_row(int y) const { return row_of_[y]; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double energy(int tile) const { return energy_[tile]; }  ///< luminance integrated over the tile
  Vec3f moment(int tile) const { return moment_[tile]; }   ///< luminance times direction, integrated
  std::size_t bytes() const { return cdf_.size() * sizeof(float); }

 private:
  int width_ = 0, height_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint16_t> column_of_, row_of_;  ///< tile column of each texel column
  std::vector<int> left_, top_;                    ///< first texel of each tile column and row, and the end
  std::vector<std::size_t> first_;                 ///< of each tile in cdf_
  std::vector<float> cdf_;
  std::vector<double> energy_;
  std::vector<Vec3f> moment_;
};

/// Blocks of 2^shift x 2^shift tiles, each with a CDF over its tiles.
class TileBins {
 public:
  TileBins(const TiledMap& map, int shift);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int shift() const { return shift_; }
  double energy(int bin) const { return energy_[bin]; }
  Vec3f centre(int bin) const { return centre_[bin]; }  ///< unit, of its light
  /// A tile of the bin and its probability within it; u is stretched to be used again.
  int choose(int bin, float& u, float& probability) const;
  float probability(int tile_column, int tile_row) const;  ///< of a tile within its bin

 private:
  int columns_ = 0, rows_ = 0, shift_ = 0, tile_columns_ = 0, tile_rows_ = 0;
  std::vector<double> energy_;
  std::vector<Vec3f> centre_;
  std::vector<float> cdf_;  ///< cdf_: 4^shift + 1 a bin
};

/// For directions of a grid the chances of the bins about them: light times lobe.
class LobeTable {
 public:
  /// alpha > 0: GGX about the mirrored view; 0: the cosine about the normal.
  LobeTable(const TileBins& bins, float alpha);

  struct Cell {
    std::uint16_t left = 0, top = 0, width = 0, height = 0;  ///< the window of bins, wrapping around
    std::uint32_t first = 0;                                 ///< in cdf
    float mass = 0;  ///< mean luminance over the lobe: 0: no light there
  };
  const Cell& cell_of(Vec3f axis) const;
  int choose(const Cell& cell, float& u, float& probability) const;
  float probability(const Cell& cell, int bin_column, int bin_row) const;
  const TileBins& bins() const { return *bins_; }
  std::size_t bytes() const { return cdf_.size() * sizeof(float) + cells_.size() * sizeof(Cell); }

 private:
  const TileBins* bins_;
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
  std::vector<float> cdf_;
};

}  // namespace welkin
