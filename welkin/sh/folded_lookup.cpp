// On a face the ray (s, t, 1 up to order and signs) has length r, and r^l Y_lm is a homogeneous polynomial of degree
// l in its components. Times r^(p - l), p - l even, hence a polynomial in r^2, it is a polynomial of total degree p in
// s and t. So with p = L for l = L, L - 2, ... and p = L - 1 for the others
//   Y_lm = sum over a + b <= p of c_ab P_a(s) P_b(t) / r^p,
//   c_ab = (2a + 1)(2b + 1) / 4 * integral over [-1, 1]^2 of r^p Y_lm P_a(s) P_b(t) ds dt,
// an integral that L + 1 Gauss nodes a side make exact. Counting both p there are (L + 1)(L + 2)/2 + L (L + 1)/2 =
// (L + 1)^2 functions, as many as harmonics. Legendre products, not powers, keep c_ab small: no digits are lost.
#include <welkin/sh/folded_lookup.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/folded_kernels.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

// P_a(s) P_b(t) / r^power.
struct FaceFunction {
  int power, a, b;
};

// Those with b even, then those with b odd.
std::vector<FaceFunction> face_functions(int max_degree) {
  std::vector<FaceFunction> functions;
  for (int parity = 0; parity < 2; ++parity)
    for (int power = max_degree; power >= std::max(0, max_degree - 1); --power)
      for (int b = parity; b <= power; b += 2)
        for (int a = 0; a + b <= power; ++a) functions.push_back({power, a, b});
  return functions;
}

// P_0 .. P_max_lookup_degree by Bonnet's recurrence.
std::array<double, max_lookup_degree + 1> legendre(double x) {
  std::array<double, max_lookup_degree + 1> p{1, x};
  for (std::size_t l = 1; l + 1 < p.size(); ++l) {
    const double n = static_cast<double>(l);
    p[l + 1] = ((2 * n + 1) * x * p[l] - n * p[l - 1]) / (n + 1);
  }
  return p;
}

void evaluate_face_functions(std::span<const FaceFunction> functions, double s, double t,
                             std::span<double> out) {
  const auto ps = legendre(s), pt = legendre(t);
  const double r = std::sqrt(1 + s * s + t * t);
  for (std::size_t k = 0; k < functions.size(); ++k)
    out[k] = ps[functions[k].a] * pt[functions[k].b] / std::pow(r, functions[k].power);
}

// basis[(lm * 6 + face) * count + k] = c_ab, see above.
std::vector<float> cube_basis(std::span<const FaceFunction> functions, int max_degree) {
  const std::size_t count = functions.size();
  const QuadratureRule rule = gauss_legendre(max_degree + 1);
  std::vector<double> basis(6 * count * count), harmonics(count);
  for (int face = 0; face < 6; ++face) {
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double s = rule.nodes[i], t = rule.nodes[j], weight = rule.weights[i] * rule.weights[j];
        const auto ps = legendre(s), pt = legendre(t);
        evaluate_sh_basis(cube_direction({face, s, t}), max_degree, harmonics);
        for (int l = 0; l <= max_degree; ++l) {
          for (std::size_t k = 0; k < count; ++k) {
            const auto [power, a, b] = functions[k];
            if ((power - l) % 2 != 0) continue;
            const double c = (2 * a + 1) * (2 * b + 1) / 4.0 * weight * ps[a] * pt[b] *
                             std::pow(1 + s * s + t * t, 0.5 * power);
            for (int m = -l; m <= l; ++m)
              basis[(sh_index(l, m) * 6 + face) * count + k] += c * harmonics[sh_index(l, m)];
          }
        }
      }
    }
  }
  return {basis.begin(), basis.end()};
}

// The harmonics themselves: those with l + m even are even under z -> -z, which exchanges the discs.
std::vector<std::size_t> disc_functions(int max_degree) {
  std::vector<std::size_t> order;
  for (int parity = 0; parity < 2; ++parity)
    for (int l = 0; l <= max_degree; ++l)
      for (int m = -l; m <= l; ++m)
        if ((l + std::abs(m)) % 2 == parity) order.push_back(sh_index(l, m));
  return order;
}

FoldedTable empty_table(MapShape shape, int max_degree, int channels) {
  check_map_shape(shape);
  if (shape.mapping != Mapping::cube && shape.mapping != Mapping::dual_paraboloid)
    throw Error("folded tables are for cubes and dual paraboloids, not for a map that is " +
                std::string(mapping_name(shape.mapping)));
  if (max_degree < 0 || max_degree > max_lookup_degree)
    throw Error("the degree of a look-up table must be between 0 and " + std::to_string(max_lookup_degree));
  if (channels < 1 || channels > 4) throw Error("a look-up table takes 1 to 4 channels");
  const bool cube = shape.mapping == Mapping::cube;
  const int size = cube ? shape.width : shape.height;
  FoldedTable table;
  table.shape = shape;
  table.max_degree = max_degree;
  table.channels = channels;
  table.parts = cube ? 6 : 1;
  table.rows = cube ? (size + 1) / 2 : size;
  table.row_floats = channels * size;
  table.blocks = (table.row_floats + FloatBlock::size - 1) / FloatBlock::size;
  return table;
}

// Fills the table with the sums of weight * function over the nodes that nodes_of(x, y) gives; evaluate(node, out)
// writes all functions.
template <class NodesOf, class Evaluate>
void fill(FoldedTable& table, NodesOf&& nodes_of, Evaluate&& evaluate) {
  const std::size_t functions = sh_count(table.max_degree);
  table.values.resize(static_cast<std::size_t>(table.rows) * table.blocks * functions);
  std::vector<double> value(functions), sum(functions);
  for (int y = 0; y < table.rows; ++y) {
    for (int x = 0; x < table.row_floats / table.channels; ++x) {
      std::fill(sum.begin(), sum.end(), 0.0);
      for (const TexelNode& node : nodes_of(x, y)) {
        evaluate(node, value);
        for (std::size_t k = 0; k < functions; ++k) sum[k] += node.weight * value[k];
      }
      for (int at = x * table.channels; at < (x + 1) * table.channels; ++at) {
        FloatBlock* block =
            &table.values[(static_cast<std::size_t>(y) * table.blocks + at / FloatBlock::size) * functions];
        for (std::size_t k = 0; k < functions; ++k)
          block[k].lanes[at % FloatBlock::size] = static_cast<float>(sum[k]);
      }
    }
  }
}

template <class NodesOf>
FoldedTable make_cube_table(FoldedTable table, NodesOf&& nodes_of) {
  const std::vector<FaceFunction> functions = face_functions(table.max_degree);
  for (const FaceFunction& function : functions) ++(function.b % 2 == 0 ? table.even : table.odd);
  table.basis = cube_basis(functions, table.max_degree);
  fill(table, nodes_of, [&](const TexelNode& node, std::span<double> out) {
    evaluate_face_functions(functions, node.a, node.b, out);
  });
  return table;
}

template <class NodesOf>
FoldedTable make_disc_table(FoldedTable table, NodesOf&& nodes_of) {
  const std::vector<std::size_t> order = disc_functions(table.max_degree);
  table.even = (table.max_degree + 1) * (table.max_degree + 2) / 2;
  table.odd = static_cast<int>(order.size()) - table.even;
  table.basis.resize(order.size() * order.size());
  for (std::size_t k = 0; k < order.size(); ++k) table.basis[order[k] * order.size() + k] = 1;
  std::vector<double> harmonics(order.size());
  fill(table, nodes_of, [&](const TexelNode& node, std::span<double> out) {
    const double scale = 1 / (1 + node.a * node.a + node.b * node.b);
    evaluate_sh_basis({2 * node.a * scale, 2 * node.b * scale, 2 * scale - 1}, table.max_degree, harmonics);
    for (std::size_t k = 0; k < order.size(); ++k) out[k] = harmonics[order[k]];
  });
  return table;
}

template <class NodesOf>
FoldedTable make_table(FoldedTable table, NodesOf&& nodes_of) {
  return table.parts == 6 ? make_cube_table(std::move(table), nodes_of)
                          : make_disc_table(std::move(table), nodes_of);
}

void check_match(const FoldedTable& table, MapShape shape, int channels) {
  if (table.shape.mapping != shape.mapping || table.shape.width != shape.width ||
      table.shape.height != shape.height || table.channels != channels)
    throw Error("the look-up table is for a map of another shape or number of channels");
}

void project_texels(const FoldedTable& table, const float* texels, ShCoefficients& out) {
  const int functions = table.functions(), channels = table.channels, moments = table.parts * functions;
  std::vector<FloatBlock> memory(moments + functions + 2 * table.blocks);
  FloatBlock *sums = memory.data(), *harmonics = sums + moments, *scratch = harmonics + functions;
  add_folded_rows(table, texels, scratch, sums);
  harmonics_of_moments(table, sums, harmonics);
  out.max_degree = table.max_degree;
  out.channels = channels;
  out.values.assign(static_cast<std::size_t>(functions) * channels, 0.0);
  for (int lm = 0; lm < functions; ++lm)
    for (int j = 0; j < FloatBlock::size; j += channels)
      for (int c = 0; c < channels; ++c) out.values[lm * channels + c] += harmonics[lm].lanes[j + c];
}

void synthesize_texels(const FoldedTable& table, const ShCoefficients& coefficients, float* texels) {
  const int functions = table.functions(), channels = table.channels;
  const int known = std::min(functions, static_cast<int>(sh_count(coefficients.max_degree)));
  std::vector<FloatBlock> memory(functions + table.parts * functions);
  FloatBlock *harmonics = memory.data(), *factors = harmonics + functions;
  for (int lm = 0; lm < known; ++lm)
    for (int j = 0; j < FloatBlock::size; j += channels)
      for (int c = 0; c < channels; ++c)
        harmonics[lm].lanes[j + c] = static_cast<float>(coefficients.values[lm * channels + c]);
  factors_of_harmonics(table, harmonics, known, factors);
  write_unfolded_rows(table, factors, texels);
}

void check_channels(const FoldedTable& table, const ShCoefficients& coefficients) {
  if (coefficients.channels != table.channels)
    throw Error("the look-up table is for another number of channels");
}

}  // namespace

// The middle row of an odd face is folded onto itself, which counts it twice: its weights are halved.
ShProjectionTable make_sh_projection_table(MapShape shape, int max_degree, int channels, TexelRule rule) {
  FoldedTable table = empty_table(shape, max_degree, channels);
  TexelNodes nodes(shape, max_degree, rule);
  std::vector<TexelNode> halved;
  return {make_table(std::move(table), [&](int x, int y) {
    const auto of_texel = nodes.of(x, y);
    halved.assign(of_texel.begin(), of_texel.end());
    if (shape.mapping == Mapping::cube && 2 * y + 1 == shape.width)
      for (TexelNode& node : halved) node.weight *= 0.5;
    return std::span<const TexelNode>(halved);
  })};
}

ShSynthesisTable make_sh_synthesis_table(MapShape shape, int max_degree, int channels) {
  FoldedTable table = empty_table(shape, max_degree, channels);
  const bool cube = shape.mapping == Mapping::cube;
  const double size = cube ? shape.width : shape.height;
  return {make_table(std::move(table), [&](int x, int y) {
    const double down = (2 * y + 1) / size - 1;
    return std::array<TexelNode, 1>{{{(2 * x + 1) / size - 1, cube ? down : -down, 1}}};
  })};
}

ShProjectionTable make_sh_projection_table(int cube_size, int max_degree, int channels, TexelRule rule) {
  return make_sh_projection_table(map_shape(Mapping::cube, cube_size), max_degree, channels, rule);
}

ShSynthesisTable make_sh_synthesis_table(int cube_size, int max_degree, int channels) {
  return make_sh_synthesis_table(map_shape(Mapping::cube, cube_size), max_degree, channels);
}

void project(const ShProjectionTable& table, const Cube& radiance, ShCoefficients& out) {
  check_match(table.folded, map_shape(Mapping::cube, radiance.size), radiance.channels);
  project_texels(table.folded, radiance.texels.data(), out);
}

void project(const ShProjectionTable& table, const SphereMap& radiance, ShCoefficients& out) {
  check_match(table.folded, radiance.shape(), radiance.image.channels);
  project_texels(table.folded, radiance.image.pixels.data(), out);
}

void synthesize(const ShSynthesisTable& table, const ShCoefficients& coefficients, Cube& out) {
  check_channels(table.folded, coefficients);
  if (table.folded.shape.mapping != Mapping::cube) throw Error("the look-up table is not for a cube");
  out.size = table.folded.shape.width;
  out.channels = table.folded.channels;
  out.texels.resize(std::size_t{6} * out.size * out.size * out.channels);
  synthesize_texels(table.folded, coefficients, out.texels.data());
}

void synthesize(const ShSynthesisTable& table, const ShCoefficients& coefficients, SphereMap& out) {
  check_channels(table.folded, coefficients);
  const MapShape shape = table.folded.shape;
  out.mapping = shape.mapping;
  out.image.width = shape.width;
  out.image.height = shape.height;
  out.image.channels = table.folded.channels;
  out.image.pixels.resize(static_cast<std::size_t>(shape.width) * shape.height * out.image.channels);
  synthesize_texels(table.folded, coefficients, out.image.pixels.data());
}

}  // namespace welkin
