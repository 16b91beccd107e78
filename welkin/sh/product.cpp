#include <welkin/sh/product.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/ring_transform.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_matrix_degree = 32;

void check_degree(const char* what, int degree, int largest) {
  if (degree < 0 || degree > largest)
    throw Error(std::string(what) + " must be between 0 and " + std::to_string(largest) + ", not " +
                std::to_string(degree));
}

void check_factors(const ShCoefficients& f, const ShCoefficients& g) {
  check_coefficients(f);
  check_coefficients(g);
  if (f.channels != g.channels)
    throw Error("coefficients with " + std::to_string(f.channels) + " and with " +
                std::to_string(g.channels) + " channels have no product");
  check_degree("the degree of a product", f.max_degree + g.max_degree, max_product_degree);
}

// The integral over phi of the azimuth functions cos m phi (m >= 0) or sin |m| phi (m < 0) of three orders. With
// zero(n) = 1 where n = 0, products of cosines become sums:
//   cos a cos b cos c: (pi/2) (zero(a+b+c) + zero(a+b-c) + zero(a-b+c) + zero(a-b-c))
//   cos a sin b sin c: (pi/2) (zero(a+b-c) + zero(a-b+c) - zero(a+b+c) - zero(a-b-c));  odd numbers of sines give 0.
double azimuth_integral(int m1, int m2, int m3) {
  std::array<int, 3> orders{m1, m2, m3};
  std::sort(orders.begin(), orders.end(), std::greater<>());  // cosines before sines
  const auto sines = std::count_if(orders.begin(), orders.end(), [](int m) { return m < 0; });
  if (sines % 2 != 0) return 0;
  const int a = orders[0], b = std::abs(orders[1]), c = std::abs(orders[2]);
  const int mixed = (a + b == c) + (a + c == b), equal = (a + b + c == 0) + (a == b + c);
  return pi / 2 * (sines == 0 ? mixed + equal : mixed - equal);
}

// p_lm(z) = Y_lm(z, phi = 0), m >= 0, at the nodes of a rule: values[sh_index(l, m) * nodes + node].
struct LegendreTable {
  QuadratureRule rule;
  std::vector<double> values;

  LegendreTable(int max_degree, int nodes)
      : rule(gauss_legendre(nodes)), values(sh_count(max_degree) * nodes) {
    std::vector<double> basis(sh_count(max_degree));
    for (int n = 0; n < nodes; ++n) {
      const double z = rule.nodes[n];
      evaluate_sh_basis({std::sqrt(1 - z * z), 0, z}, max_degree, basis);
      for (std::size_t i = 0; i < basis.size(); ++i) values[i * nodes + n] = basis[i];
    }
  }

  double integral(int l1, int m1, int l2, int m2, int l3, int m3) const {
    const std::size_t nodes = rule.nodes.size();
    const double *a = &values[sh_index(l1, std::abs(m1)) * nodes],
                 *b = &values[sh_index(l2, std::abs(m2)) * nodes],
                 *c = &values[sh_index(l3, std::abs(m3)) * nodes];
    double sum = 0;
    for (std::size_t n = 0; n < nodes; ++n) sum += rule.weights[n] * a[n] * b[n] * c[n];
    return sum;
  }
};

struct DegreeAndOrder {
  int l, m;
};
DegreeAndOrder degree_and_order(int index) {
  int l = 0;
  while ((l + 1) * (l + 1) <= index) ++l;
  return {l, index - l * (l + 1)};
}

// All k with a non-zero integral for one pair: the triangle rule and even l1 + l2 + l3, and an azimuth integral.
void add_entries(int i, int j, const LegendreTable& legendre, TripleProductTable& table) {
  const auto [l1, m1] = degree_and_order(i);
  const auto [l2, m2] = degree_and_order(j);
  for (int l3 = std::abs(l1 - l2); l3 <= std::min(l1 + l2, table.max_degree); l3 += 2)
    for (int m3 = -l3; m3 <= l3; ++m3) {
      const double azimuth = azimuth_integral(m1, m2, m3);
      if (azimuth == 0) continue;
      const double value = azimuth * legendre.integral(l1, m1, l2, m2, l3, m3);
      if (std::abs(value) < 1e-14) continue;  // a zero that no rule above foresees, up to rounding
      table.entries.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                               static_cast<std::uint16_t>(sh_index(l3, m3)), value});
    }
}

}  // namespace

ShCoefficients product(const ShCoefficients& f, const ShCoefficients& g) {
  return product(f, g, f.max_degree + g.max_degree);
}

ShCoefficients product(const ShCoefficients& f, const ShCoefficients& g, int max_degree) {
  check_factors(f, g);
  check_degree("the degree of a product", max_degree, max_product_degree);
  const int full = f.max_degree + g.max_degree, kept = std::min(max_degree, full);
  const QuadratureRule rule = gauss_legendre((full + kept) / 2 + 1);  // exact to degree full + kept
  const int azimuths = full + kept + 1;
  RingTransform ring(std::max({f.max_degree, g.max_degree, kept}), azimuths);
  ShCoefficients result(max_degree, f.channels), cut(kept, f.channels);
  std::vector<double> f_values, g_values;
  for (std::size_t n = 0; n < rule.nodes.size(); ++n) {
    ring.set_ring(rule.nodes[n]);
    ring.synthesize(f, f_values);
    ring.synthesize(g, g_values);
    for (std::size_t i = 0; i < f_values.size(); ++i) f_values[i] *= g_values[i];
    ring.add_analysis(f_values, rule.weights[n] * 2 * pi / azimuths, cut);
  }
  std::copy(cut.values.begin(), cut.values.end(), result.values.begin());
  return result;
}

// h only meets the degrees of f g that it has itself.
std::vector<double> triple_product(const ShCoefficients& f, const ShCoefficients& g,
                                   const ShCoefficients& h) {
  check_coefficients(h);
  return inner_product(product(f, g, h.max_degree), h);
}

TripleProductTable make_triple_product_table(int max_degree) {
  check_degree("the degree of a table of triple products", max_degree, max_triple_product_degree);
  TripleProductTable table;
  table.max_degree = max_degree;
  const LegendreTable legendre(max_degree, 3 * max_degree / 2 + 1);
  const int count = static_cast<int>(sh_count(max_degree));
  for (int i = 0; i < count; ++i)
    for (int j = i; j < count; ++j) add_entries(i, j, legendre, table);
  return table;
}

ShCoefficients product(const TripleProductTable& table, const ShCoefficients& f, const ShCoefficients& g) {
  check_factors(f, g);
  if (f.max_degree != table.max_degree || g.max_degree != table.max_degree)
    throw Error("the table of triple products is for coefficients of degree " +
                std::to_string(table.max_degree));
  const int channels = f.channels;
  ShCoefficients result(table.max_degree, channels);
  for (const auto& [i, j, k, value] : table.entries)
    for (int c = 0; c < channels; ++c) {
      double pairs = f.values[i * channels + c] * g.values[j * channels + c];
      if (i != j) pairs += f.values[j * channels + c] * g.values[i * channels + c];
      result.values[k * channels + c] += value * pairs;
    }
  return result;
}

std::vector<double> product_matrix(const ShCoefficients& f, int in_degree, int out_degree) {
  check_coefficients(f);
  if (f.channels != 1) throw Error("a product matrix belongs to a function of one channel");
  check_degree("the degrees of a product matrix", in_degree, max_matrix_degree);
  check_degree("the degrees of a product matrix", out_degree, max_matrix_degree);
  const ShCoefficients used =
      resize(f, std::min(f.max_degree, in_degree + out_degree));  // the rest meets nothing
  const int total = used.max_degree + in_degree + out_degree, azimuths = total + 1;
  const int basis_degree = std::max({in_degree, out_degree, used.max_degree});
  const QuadratureRule rule = gauss_legendre(total / 2 + 1);
  RingTransform ring(basis_degree, azimuths);
  const std::size_t rows = sh_count(out_degree), columns = sh_count(in_degree);
  std::vector<double> matrix(rows * columns), values, y(sh_count(basis_degree));
  for (std::size_t n = 0; n < rule.nodes.size(); ++n) {
    const double z = rule.nodes[n], r = std::sqrt(1 - z * z), weight = rule.weights[n] * 2 * pi / azimuths;
    ring.set_ring(z);
    ring.synthesize(used, values);
    for (int a = 0; a < azimuths; ++a) {
      evaluate_sh_basis({r * ring.cosine(a), r * ring.sine(a), z}, basis_degree, y);
      for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
          matrix[row * columns + column] += weight * values[a] * y[row] * y[column];
    }
  }
  return matrix;
}

}  // namespace welkin
