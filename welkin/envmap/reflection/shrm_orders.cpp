#include <welkin/envmap/reflection/shrm_orders.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/sampling/quadrature.h>
#include <welkin/sh/basis.h>

// The error is exact in the mean. At a fixed angle of the view the surface's orientation is a rotation of the
// light; over all rotations its local coefficients c_lq are uncorrelated and |c_lq|^2 has the mean A_l = sum over m
// |a_lm|^2 / (2l+1) (the D^l are orthogonal, Schur). With k_q = 1 for q = 0 and 2 for the pair +-q,
//   mean B^2           = sum over l of A_l sum over q of k_q t_lq^2,
//   mean (B - B_FP)^2  = the same sum with t_lq - sum_(p <= P) rho_lpq P_pq in place of t_lq for l <= F, q <= P.
// Nothing is assumed about the light. The energy of a degree, sum over q of k_q t_lq^2, does not depend on the
// axis, so one reference table serves both frames.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// The P_pq at each node: [term * nodes + node].
std::vector<double> term_values(ReflectionFrame frame, std::span<const ViewTerm> terms,
                                const ViewNodes& nodes, int order) {
  const std::size_t count = nodes.cos_view.size();
  std::vector<double> values(terms.size() * count), basis(sh_count(order));
  for (std::size_t i = 0; i < count; ++i) {
    const double x = view_polar_cosine(frame, nodes.cos_view[i]);
    evaluate_sh_basis({std::sqrt(std::max(0.0, 1 - x * x)), 0, x}, order, basis);
    for (std::size_t k = 0; k < terms.size(); ++k)
      values[k * count + i] =
          basis[sh_index(terms[k].p, terms[k].q)] / (terms[k].q > 0 ? std::numbers::sqrt2 : 1);
  }
  return values;
}

// 2 pi d(cos theta_v) over the whole sphere, for nodes that are uniform in the view's cosine mu: with cos theta_v =
// 2 mu^2 - 1 it is 8 pi mu dmu; about the normal 4 pi dmu, both halves.
double sphere_weight(ReflectionFrame frame, const ViewNodes& nodes, std::size_t i) {
  return nodes.weight[i] * (frame == ReflectionFrame::normal ? 4 * pi : 8 * pi * nodes.cos_view[i]);
}

// Weights of the error's mean over views.
std::vector<double> mean_weights(const ViewNodes& nodes, double smallest_cos_view) {
  std::vector<double> weights = nodes.weight;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (nodes.cos_view[i] < smallest_cos_view) weights[i] = 0;
    sum += weights[i];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double mean_square(std::span<const double> values, std::span<const double> weights) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[i] * values[i];
  return sum;
}

// left[P]: mean over views of the sum over q of k_q (t_lq - sum_(p <= P) rho_lpq P_pq)^2.
std::vector<double> residual_energies(const BrdfSpectrum& table, const ViewExpansion& expansion, int l,
                                      int channel, std::span<const double> values,
                                      std::span<const double> weights) {
  const std::size_t count = weights.size();
  const int orders = expansion.terms.back().p + 1;
  std::vector<double> left(orders), rest(count);
  std::size_t term = 0;
  for (int q = 0; q <= l; ++q) {
    std::copy_n(table.at(l, q, channel), count, rest.begin());
    double now = mean_square(rest, weights);
    for (int p = 0; p < orders; ++p) {
      if (term < expansion.terms.size() && expansion.terms[term].q == q && expansion.terms[term].p == p) {
        const double rho = expansion.at(term, l, channel);
        for (std::size_t i = 0; i < count; ++i) rest[i] -= rho * values[term * count + i];
        now = mean_square(rest, weights);
        ++term;
      }
      left[p] += (q > 0 ? 2 : 1) * now;
    }
  }
  return left;
}

}  // namespace

ViewNodes make_view_nodes(int count) {
  const QuadratureRule rule = gauss_legendre(count);
  ViewNodes nodes;
  for (int i = 0; i < count; ++i) {
    nodes.cos_view.push_back((1 + rule.nodes[i]) / 2);
    nodes.weight.push_back(rule.weights[i] / 2);
  }
  return nodes;
}

std::vector<std::array<double, 3>> mean_coefficient_power(const Spectrum& radiance) {
  assert(radiance.channels == 3);
  std::vector<std::array<double, 3>> power(radiance.max_degree + 1);
  for (int l = 0; l <= radiance.max_degree; ++l)
    for (int m = 0; m <= l; ++m)
      for (int c = 0; c < 3; ++c)
        power[l][c] +=
            (m > 0 ? 2 : 1) * std::norm(radiance.values[radiance.index(l, m) * 3 + c]) / (2 * l + 1);
  return power;
}

std::vector<ViewTerm> view_terms(ReflectionFrame frame, int order) {
  std::vector<ViewTerm> terms;
  for (int q = 0; q <= order; ++q)
    for (int p = q; p <= order; p += frame == ReflectionFrame::normal ? 2 : 1) terms.push_back({p, q});
  return terms;
}

double view_polar_cosine(ReflectionFrame frame, double cos_view) {
  return frame == ReflectionFrame::normal ? cos_view : 2 * cos_view * cos_view - 1;
}

ViewExpansion expand_views(const BrdfSpectrum& table, const ViewNodes& nodes, int max_degree, int order) {
  assert(max_degree <= table.max_degree && order <= table.max_order && table.cos_views == nodes.cos_view);
  ViewExpansion expansion{view_terms(table.frame, order), max_degree, table.channels, {}};
  expansion.values.resize(expansion.terms.size() * (max_degree + 1) * table.channels);
  const std::size_t count = nodes.cos_view.size();
  const std::vector<double> values = term_values(table.frame, expansion.terms, nodes, order);
  for (std::size_t k = 0; k < expansion.terms.size(); ++k) {
    for (int l = expansion.terms[k].q; l <= max_degree; ++l) {
      for (int c = 0; c < table.channels; ++c) {
        const double* t = table.at(l, expansion.terms[k].q, c);
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
          sum += sphere_weight(table.frame, nodes, i) * t[i] * values[k * count + i];
        expansion.values[(k * (max_degree + 1) + l) * table.channels + c] = sum;
      }
    }
  }
  return expansion;
}

double OrderErrors::error(int max_degree, int order) const {
  double sum = beyond_table;
  for (int l = 0; l < static_cast<int>(dropped.size()); ++l)
    sum += l <= max_degree ? kept[order][l] : dropped[l];
  return sum;
}

double OrderErrors::relative_error(int max_degree, int order) const {
  return signal > 0 ? std::sqrt(error(max_degree, order) / signal) : 0;
}

OrderErrors order_errors(std::span<const std::array<double, 3>> power, const BrdfSpectrum& reference,
                         const BrdfSpectrum& table, const ViewExpansion& expansion, const ViewNodes& nodes,
                         double smallest_cos_view) {
  const int degrees = reference.max_degree + 1, max_order = expansion.terms.back().p;
  assert(reference.max_order == reference.max_degree && table.max_order == table.max_degree &&
         static_cast<int>(power.size()) >= degrees);
  const std::size_t count = nodes.cos_view.size();
  const std::vector<double> weights = mean_weights(nodes, smallest_cos_view);
  const std::vector<double> values = term_values(table.frame, expansion.terms, nodes, max_order);
  OrderErrors errors;
  errors.dropped.assign(degrees, 0.0);
  errors.kept.assign(max_order + 1, std::vector<double>(degrees, 0.0));
  for (int c = 0; c < 3; ++c) {
    const int reference_channel = reference.channels == 1 ? 0 : c, channel = table.channels == 1 ? 0 : c;
    double beyond = 0;
    for (std::size_t i = 0; i < count; ++i)
      beyond += weights[i] * reference.total_energy[reference_channel * count + i];
    for (int l = 0; l < degrees; ++l) {
      double energy = 0;
      for (int q = 0; q <= l; ++q)
        energy += (q > 0 ? 2 : 1) * mean_square({reference.at(l, q, reference_channel), count}, weights);
      beyond -= energy;
      errors.dropped[l] += power[l][c] * energy;
      if (l > expansion.max_degree) continue;
      const std::vector<double> left = residual_energies(table, expansion, l, channel, values, weights);
      for (int order = 0; order <= max_order; ++order) errors.kept[order][l] += power[l][c] * left[order];
    }
    double last_power = 0;  // per coefficient, over the upper half of the degrees
    for (int l = degrees / 2; l < degrees; ++l) last_power += power[l][c] / (degrees - degrees / 2);
    errors.beyond_table += std::max(0.0, beyond) * last_power;
  }
  errors.signal = errors.beyond_table;
  for (const double value : errors.dropped) errors.signal += value;
  return errors;
}

}  // namespace welkin
