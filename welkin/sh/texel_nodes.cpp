#include <welkin/sh/texel_nodes.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <welkin/error.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

// Along a texel of half-width w = 1/N the integrand is a trigonometric polynomial of degree l in an angle that
// advances by at most `rate` per unit (1 on a cube face, 2 on the stereographic disc), over a power of 1 + s^2 + t^2.
// The first needs the rule for cos(l rate s); the second is analytic within the ellipse through +-i, whose axes add
// up to rho = N + sqrt(N^2 + 1), so that n nodes are off by rho^(-2n). Their product needs both together.
int node_count(MapShape shape, int size, int max_degree) {
  const double phase = max_degree * (shape.mapping == Mapping::cube ? 1.0 : 2.0) / size;
  const double rho = size + std::hypot(size, 1.0);
  int count = 1;
  while (gauss_legendre_error(count, phase) > 1e-13) ++count;
  return std::max(count, static_cast<int>(std::ceil(6 / std::log10(rho) + phase)) + 2);
}

struct Interval {
  double from, to;

  double at(double node) const { return from + 0.5 * (to - from) * (node + 1); }
  double half() const { return 0.5 * (to - from); }
};

}  // namespace

TexelNodes::TexelNodes(MapShape shape, int max_degree, TexelRule rule)
    : shape_(shape), size_(shape.mapping == Mapping::cube ? shape.width : shape.height), rule_(rule) {
  check_map_shape(shape);
  if (shape.mapping != Mapping::cube && shape.mapping != Mapping::dual_paraboloid)
    throw Error("texels can be integrated only over cubes and dual paraboloids, not over a map that is " +
                std::string(mapping_name(shape.mapping)));
  if (rule == TexelRule::integrated) gauss_ = gauss_legendre(node_count(shape, size_, max_degree));
}

TexelNodes::Box TexelNodes::box(int x, int y) const {
  const double n = size_;
  if (shape_.mapping == Mapping::cube) {
    y %= size_;
    return {2 * x / n - 1, 2 * (x + 1) / n - 1, 2 * y / n - 1, 2 * (y + 1) / n - 1};
  }
  x %= size_;  // b grows upwards
  return {2 * x / n - 1, 2 * (x + 1) / n - 1, 1 - 2 * (y + 1) / n, 1 - 2 * y / n};
}

double TexelNodes::density(double a, double b) const {
  const double q = 1 + a * a + b * b;
  return shape_.mapping == Mapping::cube ? 1 / (q * std::sqrt(q)) : 4 / (q * q);
}

std::span<const TexelNode> TexelNodes::of(int x, int y) {
  nodes_.clear();
  const Box texel = box(x, y);
  if (rule_ == TexelRule::centre) {
    const double solid_angle = map_texel_solid_angle(shape_, x, y);
    if (solid_angle > 0)
      nodes_.push_back({0.5 * (texel.a0 + texel.a1), 0.5 * (texel.b0 + texel.b1), solid_angle});
  } else if (shape_.mapping == Mapping::cube) {
    add_box(texel);
  } else {
    add_clipped(texel);
  }
  return nodes_;
}

Vec3 TexelNodes::direction(int x, int y, const TexelNode& node) const {
  if (shape_.mapping == Mapping::cube) return cube_direction({y / size_, node.a, node.b});
  const double r2 = node.a * node.a + node.b * node.b, scale = 1 / (1 + r2);
  return {2 * node.a * scale, 2 * node.b * scale, (x < size_ ? 1 : -1) * (1 - r2) * scale};
}

void TexelNodes::add_box(const Box& box) {
  const Interval along_a{box.a0, box.a1}, along_b{box.b0, box.b1};
  for (std::size_t j = 0; j < gauss_.nodes.size(); ++j) {
    const double b = along_b.at(gauss_.nodes[j]), weight = along_b.half() * gauss_.weights[j];
    for (std::size_t i = 0; i < gauss_.nodes.size(); ++i) {
      const double a = along_a.at(gauss_.nodes[i]);
      nodes_.push_back({a, b, weight * along_a.half() * gauss_.weights[i] * density(a, b)});
    }
  }
}

// The part of a box inside the unit circle. Boxes that the circle cuts are quartered until they are small and lie in
// one quadrant, so that add_rim sees a short, smooth arc.
void TexelNodes::add_clipped(const Box& box) {
  const auto farthest = [](double from, double to) { return std::max(std::abs(from), std::abs(to)); };
  const auto nearest = [](double from, double to) {
    return from * to <= 0 ? 0 : std::min(std::abs(from), std::abs(to));
  };
  if (std::hypot(nearest(box.a0, box.a1), nearest(box.b0, box.b1)) >= 1) return;
  if (std::hypot(farthest(box.a0, box.a1), farthest(box.b0, box.b1)) <= 1) return add_box(box);
  const bool straddles_a = box.a0 < 0 && box.a1 > 0, straddles_b = box.b0 < 0 && box.b1 > 0;
  if (!straddles_a && !straddles_b && box.a1 - box.a0 <= 0.126 && box.b1 - box.b0 <= 0.126)
    return add_rim(box);
  const double a = straddles_a ? 0 : 0.5 * (box.a0 + box.a1), b = straddles_b ? 0 : 0.5 * (box.b0 + box.b1);
  add_clipped({box.a0, a, box.b0, b});
  add_clipped({a, box.a1, box.b0, b});
  add_clipped({box.a0, a, b, box.b1});
  add_clipped({a, box.a1, b, box.b1});
}

// In absolute values, with v the larger coordinate: u runs over the box, v from the box's edge to the circle
// v = sqrt(1 - u^2), which is smooth there because u is not near 1. The range of u is cut where the circle meets the
// edges v0 and v1.
void TexelNodes::add_rim(const Box& box) {
  const double sign_a = box.a0 + box.a1 < 0 ? -1 : 1, sign_b = box.b0 + box.b1 < 0 ? -1 : 1;
  const bool a_is_larger = std::abs(box.a0 + box.a1) > std::abs(box.b0 + box.b1);
  const auto absolute = [](double from, double to) {
    return Interval{std::min(std::abs(from), std::abs(to)), std::max(std::abs(from), std::abs(to))};
  };
  const Interval range_a = absolute(box.a0, box.a1), range_b = absolute(box.b0, box.b1);
  const Interval u = a_is_larger ? range_b : range_a, v = a_is_larger ? range_a : range_b;
  const auto circle = [](double w) { return std::sqrt(std::max(0.0, (1 - w) * (1 + w))); };
  const double full = std::clamp(circle(v.to), u.from, u.to), end = std::clamp(circle(v.from), u.from, u.to);
  for (const Interval piece : {Interval{u.from, full}, Interval{full, end}}) {
    if (!(piece.to > piece.from)) continue;
    for (std::size_t i = 0; i < gauss_.nodes.size(); ++i) {
      const double uu = piece.at(gauss_.nodes[i]);
      const Interval inner{v.from, std::min(v.to, circle(uu))};
      for (std::size_t j = 0; j < gauss_.nodes.size(); ++j) {
        const double vv = inner.at(gauss_.nodes[j]);
        const double a = sign_a * (a_is_larger ? vv : uu), b = sign_b * (a_is_larger ? uu : vv);
        nodes_.push_back(
            {a, b, piece.half() * gauss_.weights[i] * inner.half() * gauss_.weights[j] * density(a, b)});
      }
    }
  }
}

}  // namespace welkin
