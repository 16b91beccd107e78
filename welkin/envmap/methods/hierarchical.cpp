#include <welkin/envmap/methods/hierarchical.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/map_pyramid.h>
#include <welkin/error.h>

namespace welkin {
namespace {

struct Node {
  int level, x, y;
};

// The nodes that are summed for one direction, with what the kernel needs to know of them.
struct Parts {
  std::vector<double> one_minus_cos, area, kernel;
  std::vector<const float*> radiance;

  void add(double u, double solid_angle, const float* rgb) {
    one_minus_cos.push_back(u);
    area.push_back(solid_angle);
    radiance.push_back(rgb);
  }
};

class LobeSum {
 public:
  LobeSum(const MapPyramid& pyramid, const ZonalKernel& kernel, double detail)
      : pyramid_(pyramid), kernel_(kernel), detail_(detail), width_(angular_width(kernel)) {}

  void operator()(Vec3 direction, double* rgb) const {
    Parts parts;
    double sum[3] = {}, weight = 0;
    const auto add = [&](double w, const float* radiance) {
      for (int c = 0; c < 3; ++c) sum[c] += w * static_cast<double>(radiance[c]);
      weight += w;
    };
    std::vector<Node> open{{pyramid_.top(), 0, 0}};
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      const Vec3 centre = pyramid_.direction(node.level, node.x, node.y);
      const Vec3 chord = centre - direction;
      const double squared = dot(chord, chord);
      const float* radiance = pyramid_.radiance(node.level, node.x, node.y);
      if (is_small(node, squared)) {
        parts.add(squared / 2, pyramid_.solid_angle(node.level, node.x, node.y), radiance);
      } else if (node.level == 0) {
        add(integrate_kernel(kernel_, direction, pyramid_.patch(0, node.x, node.y)), radiance);
      } else {
        split(node, open);
      }
    }
    parts.kernel.resize(parts.area.size());
    evaluate(kernel_, parts.one_minus_cos, parts.kernel);
    for (std::size_t i = 0; i < parts.area.size(); ++i)
      add(parts.kernel[i] * parts.area[i], parts.radiance[i]);
    for (int c = 0; c < 3; ++c) rgb[c] = weight > 0 ? sum[c] / weight : 0;
  }

 private:
  // The distance is that of the node's nearest point, or less; a chord is no longer than its arc.
  bool is_small(const Node& node, double squared_chord) const {
    const double half = pyramid_.half_size(node.level, node.y);
    const double nearest = std::max(0.0, std::sqrt(squared_chord) - half);
    return detail_ * half <= std::hypot(width_, nearest);
  }

  void split(const Node& node, std::vector<Node>& open) const {
    const int finer = node.level - 1;
    for (int y = 2 * node.y; y < std::min(2 * node.y + 2, pyramid_.rows(finer)); ++y)
      for (int x = 2 * node.x; x < std::min(2 * node.x + 2, pyramid_.columns(finer)); ++x)
        open.push_back({finer, x, y});
  }

  const MapPyramid& pyramid_;
  const ZonalKernel& kernel_;
  double detail_, width_;
};

}  // namespace

Cube filter_hierarchical(const Image& radiance, const FilterTarget& target,
                         const HierarchicalOptions& options) {
  if (!(options.detail >= 0.5 && options.detail <= 64)) throw Error("hierarchical: detail is 0.5 to 64");
  const MapPyramid pyramid(radiance);
  const LobeSum lobe(pyramid, target.kernel, options.detail);
  return cube_from_directions(
      target, [&](Vec3 direction, double* rgb) { lobe(direction, rgb); }, options.progress);
}

}  // namespace welkin
