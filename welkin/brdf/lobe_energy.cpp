#include <welkin/brdf/lobe_energy.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr int most_lobes = 4;
constexpr std::array<double, 3> luminance_weights = {0.2126, 0.7152, 0.0722};

// Inner products over the sphere, by the rings about the first lobe.
struct Products {
  double shapes[most_lobes][most_lobes] = {};
  double with_slice[most_lobes][3] = {};
  std::array<double, 3> total{};  // integral of the slice
};

// Calls visit(weight, light, shapes' values) for every node that counts.
template <class Visit>
void over_sphere(const LobeSlice& slice, const RingNodes& nodes, const std::vector<FittedLobe>& lobes,
                 Visit&& visit) {
  for (std::size_t k = 0; k < nodes.angles.size(); ++k)
    for (int m = 0; m < ring_points; ++m) {
      const LocalVec light = ring_point(lobes[0].axis, nodes.angles[k], m);
      if (!slice.counts(light)) continue;
      double shapes[most_lobes];
      for (std::size_t j = 0; j < lobes.size(); ++j) {
        const double cosine = std::clamp(dot(light, lobe_axis(lobes[j].axis)), -1.0, 1.0);
        shapes[j] = j == 0 ? lobes[0].values[k] : shape_at(nodes, lobes[j].values, std::acos(cosine));
      }
      visit(nodes.weights[k] / ring_points, light, shapes);
    }
}

Products products_of(const LobeSlice& slice, const RingNodes& nodes, const std::vector<FittedLobe>& lobes) {
  Products products;
  over_sphere(slice, nodes, lobes, [&](double weight, LocalVec light, const double* shapes) {
    const auto value = slice.value(light);
    for (int c = 0; c < 3; ++c) products.total[c] += weight * value[c];
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      for (std::size_t j = 0; j < lobes.size(); ++j) products.shapes[i][j] += weight * shapes[i] * shapes[j];
      for (int c = 0; c < 3; ++c) products.with_slice[i][c] += weight * shapes[i] * value[c];
    }
  });
  return products;
}

// Least squares with energies >= 0 for one channel, by coordinate descent: the matrix is positive (semi)definite, and a
// few hundred rounds settle two to four overlapping lobes.
void solve(const Products& products, int channel, std::vector<FittedLobe>& lobes) {
  for (int round = 0; round < 400; ++round)
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      double rest = products.with_slice[i][channel];
      for (std::size_t j = 0; j < lobes.size(); ++j)
        if (j != i) rest -= products.shapes[i][j] * lobes[j].energy[channel];
      const double norm = products.shapes[i][i];
      lobes[i].energy[channel] = norm > 0 ? std::max(0.0, rest / norm) : 0;
    }
}

void scale_to_total(const Products& products, int channel, std::vector<FittedLobe>& lobes) {
  double sum = 0;
  for (const FittedLobe& lobe : lobes) sum += lobe.energy[channel];
  if (sum <= 0) return;
  for (FittedLobe& lobe : lobes) lobe.energy[channel] *= products.total[channel] / sum;
}

double relative_error(const LobeSlice& slice, const RingNodes& nodes, const std::vector<FittedLobe>& lobes) {
  double error = 0, norm = 0;
  over_sphere(slice, nodes, lobes, [&](double weight, LocalVec light, const double* shapes) {
    const double truth = slice.luminance(light);
    double fit = 0;
    for (std::size_t j = 0; j < lobes.size(); ++j)
      for (int c = 0; c < 3; ++c) fit += luminance_weights[c] * lobes[j].energy[c] * shapes[j];
    error += weight * (fit - truth) * (fit - truth);
    norm += weight * truth * truth;
  });
  return norm > 0 ? std::sqrt(error / norm) : 0;
}

}  // namespace

LobeFit with_energies(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& lobes,
                      LobeTarget target) {
  LobeFit fit;
  for (const WorkingLobe& lobe : lobes) {
    FittedLobe fitted{lobe.axis, lobe.parameter, lobe.values, {}};
    double integral = 0;
    for (std::size_t k = 0; k < lobe.values.size(); ++k) integral += nodes.weights[k] * lobe.values[k];
    if (!(integral > 0)) {  // a lobe that found nothing to fit: any shape does, its energy is 0
      fitted.values.assign(lobe.values.size(), 1);
      integral = 4 * std::numbers::pi;
    }
    for (double& value : fitted.values) value /= integral;
    fit.lobes.push_back(std::move(fitted));
  }
  const Products products = products_of(slice, nodes, fit.lobes);
  for (int c = 0; c < 3; ++c) {
    solve(products, c, fit.lobes);
    if (target == LobeTarget::brdf_times_cosine) scale_to_total(products, c, fit.lobes);
  }
  fit.relative_error = relative_error(slice, nodes, fit.lobes);
  return fit;
}

}  // namespace welkin
