#pragma once
#include <array>
#include <vector>

#include <welkin/brdf/ggx.h>
#include <welkin/brdf/isotropic.h>
#include <welkin/brdf/lobe_fit.h>

// Means of a BRDF's slice over rings about an axis: private to welkin/brdf.

namespace welkin {

/// Angles from an axis with weights for integrals over the sphere: sum of weight[k] f(angle[k]) = integral of f.
struct RingNodes {
  std::vector<double> angles, weights;
  explicit RingNodes(double angular_width);
};

/// What is to be fitted for one view: f or f cos_light, as luminance or a channel. The view is in the plane y = 0 at
/// x > 0, the mirror direction at x < 0.
class LobeSlice {
 public:
  LobeSlice(const IsotropicBrdf& brdf, double view_angle, LobeTarget target);

  /// Zero below the horizon. light: unit.
  std::array<double, 3> value(LocalVec light) const;
  double luminance(LocalVec light) const;
  /// Whether the fit is to be good there: everywhere, or above the horizon alone.
  bool counts(LocalVec light) const;

 private:
  const IsotropicBrdf& brdf_;
  double cos_view_;
  LobeTarget target_;
};

/// The unit vector `axis` radians from the normal, away from the view.
LocalVec lobe_axis(double axis);

constexpr int ring_points = 32;  ///< of half a ring; the other half is its mirror image

/// Point m of the ring at `angle` from the axis, m < ring_points.
LocalVec ring_point(double axis, double angle, int m);

/// The value of a tabulated shape at an angle: linear between nodes.
double shape_at(const RingNodes& nodes, const std::vector<double>& values, double angle);

/// Of the luminance that the other lobes leave, per node: its mean over the part of the ring that counts, that of its
/// square, and the share that counts.
struct RingMeans {
  std::vector<double> mean, square, share;
  explicit RingMeans(std::size_t count) : mean(count), square(count), share(count) {}
};

/// A lobe as the fit works with it: luminance per steradian at the nodes.
struct WorkingLobe {
  double axis = 0, parameter = 0;
  std::vector<double> values;
};

RingMeans ring_means(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& others,
                     double axis);

}  // namespace welkin
