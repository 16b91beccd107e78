#include <welkin/envmap/light_regions.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <welkin/envmap/statistics.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr std::uint32_t none = UINT32_MAX;

double luminance(const float* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// A connected component of the texels above the present threshold, as long as it is compact.
struct Component {
  LightRegion region;
  double peak = 0;
};

class RegionFinder {
 public:
  RegionFinder(const Image& map, const LightRegionOptions& options) : map_(map), options_(options) {}

  std::vector<LightRegion> run() {
    const double floor = options_.floor_over_mean * mean_luminance();
    collect(floor);
    for (std::uint32_t i = 0; i < order_.size(); ++i) add(i);
    for (std::uint32_t i = 0; i < order_.size(); ++i)
      if (slot_[i] != none) finish(components_[slot_[i]], 0);
    std::stable_sort(found_.begin(), found_.end(),
                     [](const LightRegion& a, const LightRegion& b) { return a.flux > b.flux; });
    return std::move(found_);
  }

 private:
  double mean_luminance() const {
    const auto mean = map_statistics(map_).mean_radiance;
    return 0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2];
  }

  // The texels above the floor, brightest first, and the way from a texel to its place in that order.
  void collect(double floor) {
    const std::size_t count = static_cast<std::size_t>(map_.width) * map_.height;
    for (std::size_t i = 0; i < count; ++i)
      if (luminance(&map_.pixels[3 * i]) > floor) order_.push_back(static_cast<std::uint32_t>(i));
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return luminance(&map_.pixels[3 * std::size_t{a}]) > luminance(&map_.pixels[3 * std::size_t{b}]);
    });
    rank_.assign(count, none);
    for (std::uint32_t i = 0; i < order_.size(); ++i) rank_[order_[i]] = i;
    parent_.assign(order_.size(), none);
    slot_.assign(order_.size(), none);
  }

  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  // Roots of the components beside a texel. Beyond a pole lies the column half way round.
  void neighbours(std::uint32_t texel, std::vector<std::uint32_t>& roots) {
    roots.clear();
    const int width = map_.width, x0 = static_cast<int>(texel) % width, y0 = static_cast<int>(texel) / width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        int x = x0 + dx, y = y0 + dy;
        if (y < 0 || y >= map_.height) x += width / 2, y = y0;
        x = (x % width + width) % width;
        const std::uint32_t rank = rank_[static_cast<std::size_t>(y) * width + x];
        if (rank == none || parent_[rank] == none) continue;
        if (const auto r = root(rank); std::find(roots.begin(), roots.end(), r) == roots.end())
          roots.push_back(r);
      }
  }

  double value(std::uint32_t texel) const { return luminance(&map_.pixels[3 * std::size_t{texel}]); }

  void add_sums(LightRegion& region, std::uint32_t texel) const {
    const int x = static_cast<int>(texel % map_.width), y = static_cast<int>(texel / map_.width);
    const double solid_angle = equirect_texel_solid_angle(map_.width, map_.height, y);
    region.solid_angle += solid_angle;
    region.area_moment = region.area_moment + equirect_texel_moment(map_.width, map_.height, x, y);
    region.flux += value(texel) * solid_angle;
  }

  // The next texel with the components beside it, without their lists of texels.
  Component joined(std::uint32_t texel) const {
    Component whole;
    whole.peak = value(texel);
    add_sums(whole.region, texel);
    for (std::uint32_t r : beside_) {
      const Component& c = components_[slot_[r]];
      whole.peak = std::max(whole.peak, c.peak);
      whole.region.solid_angle += c.region.solid_angle;
      whole.region.area_moment = whole.region.area_moment + c.region.area_moment;
      whole.region.flux += c.region.flux;
    }
    return whole;
  }

  bool is_compact(const Component& c, double luminance_here) const {
    return luminance_here >= options_.edge_over_peak * c.peak &&
           equivalent_radius(c.region.solid_angle, c.region.area_moment) <= options_.max_angular_radius;
  }

  // Lowers the threshold to the next texel. It joins the components beside it where the whole stays compact; else
  // those that were compact until now are results.
  void add(std::uint32_t i) {
    const std::uint32_t texel = order_[i];
    const double luminance_here = value(texel);
    neighbours(texel, beside_);
    bool compact =
        std::all_of(beside_.begin(), beside_.end(), [&](std::uint32_t r) { return slot_[r] != none; });
    Component whole;
    if (compact) {
      whole = joined(texel);
      compact = is_compact(whole, luminance_here);
    }
    parent_[i] = i;
    for (std::uint32_t r : beside_) {
      parent_[r] = i;
      if (slot_[r] == none) continue;
      Component& c = components_[slot_[r]];
      if (compact)
        join(whole.region.texels, c.region.texels);
      else
        finish(c, luminance_here);
      c = {};
      free_.push_back(std::exchange(slot_[r], none));
    }
    if (!compact) return;
    whole.region.texels.push_back(texel);
    slot_[i] = keep(std::move(whole));
  }

  std::uint32_t keep(Component&& component) {
    if (free_.empty()) {
      components_.push_back(std::move(component));
      return static_cast<std::uint32_t>(components_.size() - 1);
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    components_[slot] = std::move(component);
    return slot;
  }

  // Small into large, so that no texel moves more than log n times.
  static void join(std::vector<std::uint32_t>& into, std::vector<std::uint32_t>& from) {
    if (into.size() < from.size()) into.swap(from);
    into.insert(into.end(), from.begin(), from.end());
  }

  // What a component had before the threshold came down to `luminance_here`: texels of just that luminance do not
  // count, so that a flat area that is too large is not taken in pieces.
  void finish(Component& c, double luminance_here) {
    if (c.peak <= luminance_here) return;
    LightRegion region;
    for (std::uint32_t texel : c.region.texels)
      if (value(texel) > luminance_here) {
        add_sums(region, texel);
        region.texels.push_back(texel);
      }
    std::sort(region.texels.begin(), region.texels.end(),
              [&](std::uint32_t a, std::uint32_t b) { return rank_[a] < rank_[b]; });
    found_.push_back(std::move(region));
  }

  const Image& map_;
  LightRegionOptions options_;
  std::vector<std::uint32_t> order_;   // texels, brightest first
  std::vector<std::uint32_t> rank_;    // of every texel of the map: its place in order_
  std::vector<std::uint32_t> parent_;  // of the union-find, by rank
  std::vector<std::uint32_t> slot_;    // by rank of a root: its component; none where it has grown too large
  std::vector<Component> components_;
  std::vector<std::uint32_t> free_;  // slots
  std::vector<std::uint32_t> beside_;
  std::vector<LightRegion> found_;
};

}  // namespace

double equivalent_radius(double solid_angle, Vec3 area_moment) {
  const double length = std::sqrt(dot(area_moment, area_moment));
  return 2 * std::sqrt(std::max(0.0, 1 - length / solid_angle));
}

std::vector<LightRegion> find_light_regions(const Image& equirect, const LightRegionOptions& options) {
  assert(equirect.channels == 3);
  return RegionFinder(equirect, options).run();
}

}  // namespace welkin
