#include <welkin/envmap/reflection/truth.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/envmap/statistics.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sampling/sequence.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rule_count = 8;
constexpr std::array<int, rule_count> rule_nodes = {1, 2, 3, 4, 6, 8, 12, 16};

// Sines and cosines at the nodes of every rule in every row (theta) or column (phi) of a map.
struct NodeTable {
  std::vector<double> sine, cosine;  // [row or column * nodes + node]
  std::vector<double> weight;        // rows: of the texel's solid angle; columns: 1 in all
};

struct MapNodes {
  std::array<NodeTable, rule_count> rows, columns;
};

NodeTable row_table(int height, int nodes) {
  const QuadratureRule rule = gauss_legendre(nodes);
  const double half = pi / (2.0 * height);
  NodeTable table;
  for (int y = 0; y < height; ++y) {
    double sum = 0;
    for (int i = 0; i < nodes; ++i) {
      const double theta = (2 * y + 1 + rule.nodes[i]) * half;
      table.sine.push_back(std::sin(theta));
      table.cosine.push_back(std::cos(theta));
      sum += rule.weights[i] * std::sin(theta);
    }
    for (int i = 0; i < nodes; ++i) table.weight.push_back(rule.weights[i] * table.sine[y * nodes + i] / sum);
  }
  return table;
}

NodeTable column_table(int width, int nodes) {
  const QuadratureRule rule = gauss_legendre(nodes);
  NodeTable table;
  for (int x = 0; x < width; ++x) {
    for (int i = 0; i < nodes; ++i) {
      const double phi = (2 * x + 1 + rule.nodes[i]) * pi / width - pi;
      table.sine.push_back(std::sin(phi));
      table.cosine.push_back(std::cos(phi));
      table.weight.push_back(0.5 * rule.weights[i]);
    }
  }
  return table;
}

MapNodes place_nodes(const Image& map) {
  MapNodes nodes;
  for (int r = 0; r < rule_count; ++r) {
    nodes.rows[r] = row_table(map.height, rule_nodes[r]);
    nodes.columns[r] = column_table(map.width, rule_nodes[r]);
  }
  return nodes;
}

// The rule for an interval of half width h when the integrand varies over an angle s: the error falls as rho^(-2n),
// rho = s/h + sqrt((s/h)^2 + 1) (Trefethen 2008, theorem 4.5).
int choose_rule(double half_width, double scale, double error) {
  const double ratio = scale / half_width, rho = ratio + std::hypot(ratio, 1.0);
  const double wanted = -std::log(error) / (2 * std::log(rho));
  for (int r = 0; r < rule_count; ++r)
    if (rule_nodes[r] >= wanted) return r;
  return rule_count - 1;
}

// The local frame of a query: z = normal, x = the view's side.
struct Frame {
  Vec3 normal, side, across;
  double cos_view = 0;

  explicit Frame(const ReflectionQuery& query)
      : normal(query.normal), cos_view(dot(query.normal, query.view)) {
    Vec3 tangent = query.view - cos_view * normal;
    if (length(tangent) < 1e-9)  // seen from above: any tangent does
      tangent = cross(normal, std::abs(normal.y) < 0.7 ? Vec3{0, 1, 0} : Vec3{1, 0, 0});
    side = normalized(tangent);
    across = cross(normal, side);
  }
};

void add_texel(const IsotropicBrdf& brdf, const Frame& frame, const NodeTable& rows, int row_nodes, int y,
               const NodeTable& columns, int column_nodes, int x, double* sums) {
  for (int i = y * row_nodes; i < (y + 1) * row_nodes; ++i) {
    for (int j = x * column_nodes; j < (x + 1) * column_nodes; ++j) {
      const Vec3 light{rows.sine[i] * columns.cosine[j], rows.cosine[i], rows.sine[i] * columns.sine[j]};
      const double cos_light = dot(light, frame.normal);
      if (cos_light <= 0) continue;
      const double azimuth = std::atan2(std::abs(dot(light, frame.across)), dot(light, frame.side));
      const auto f = brdf.value(std::min(1.0, cos_light), std::min(1.0, frame.cos_view), azimuth);
      const double weight = rows.weight[i] * columns.weight[j] * cos_light;
      for (int c = 0; c < 3; ++c) sums[c] += weight * f[c];
    }
  }
}

// Error asked of a texel, relative: what is bright must be integrated better, what is dark less.
double texel_error(double brightness, double mean) {
  return std::clamp(1e-5 * mean / std::max(brightness, 1e-300), 1e-9, 1e-3);
}

void reflect_one(const Image& map, const MapNodes& nodes, double mean, const IsotropicBrdf& brdf,
                 const ReflectionQuery& query, double* rgb) {
  const Frame frame(query);
  if (frame.cos_view <= 0) return;
  const double half_row = pi / (2.0 * map.height);
  for (int y = 0; y < map.height; ++y) {
    const double theta = (2 * y + 1) * half_row, sine = std::sin(theta), cosine = std::cos(theta);
    const double half_column = pi / map.width * std::min(1.0, sine + half_row);
    const double solid_angle = 4 * pi / map.width * sine * std::sin(half_row);
    const double reach = std::hypot(half_row, half_column);
    for (int x = 0; x < map.width; ++x) {
      const double phi = (2 * x + 1) * pi / map.width - pi;
      const double height = sine * std::cos(phi) * frame.normal.x + cosine * frame.normal.y +
                            sine * std::sin(phi) * frame.normal.z;
      if (height < -reach) continue;
      const float* texel = map.at(x, y);
      const double brightness = std::max({texel[0], texel[1], texel[2]});
      if (brightness == 0) continue;
      const double error = texel_error(brightness, mean);
      int row_rule = choose_rule(half_row, brdf.angular_width, error);
      int column_rule = choose_rule(half_column, brdf.angular_width, error);
      if (height < reach) {  // the horizon cuts the integrand off with a kink, where rules converge slowly
        const int finer = brightness > 4 * mean ? rule_count - 1 : 3;
        row_rule = std::max(row_rule, finer), column_rule = std::max(column_rule, finer);
      }
      double sums[3] = {};
      add_texel(brdf, frame, nodes.rows[row_rule], rule_nodes[row_rule], y, nodes.columns[column_rule],
                rule_nodes[column_rule], x, sums);
      for (int c = 0; c < 3; ++c) rgb[c] += solid_angle * texel[c] * sums[c];
    }
  }
}

// A number in [0, 1) from the seed, the query and the dimension.
double uniform(unsigned seed, int query, int dimension) {
  const std::uint64_t key = (std::uint64_t{seed} << 34) ^ (static_cast<std::uint64_t>(query) << 2);
  return static_cast<double>(mix_bits(key + static_cast<std::uint64_t>(dimension)) >> 11) * 0x1p-53;
}

Vec3 from_pole(Vec3 pole, double cosine, double azimuth) {
  const Vec3 x = normalized(cross(pole, std::abs(pole.y) < 0.7 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
  const Vec3 y = cross(pole, x);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return normalized(cosine * pole + sine * std::cos(azimuth) * x + sine * std::sin(azimuth) * y);
}

}  // namespace

std::vector<double> reflect_brute_force(const Image& radiance, const IsotropicBrdf& brdf,
                                        std::span<const ReflectionQuery> queries) {
  assert(radiance.channels == 3 && brdf.angular_width > 0);
  const MapNodes nodes = place_nodes(radiance);
  const std::array<double, 3> means = map_statistics(radiance).mean_radiance;
  const double mean = std::max({means[0], means[1], means[2]});
  std::vector<double> reflected(3 * queries.size());
  parallel_for(queries.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      reflect_one(radiance, nodes, mean, brdf, queries[i], &reflected[3 * i]);
  });
  return reflected;
}

std::vector<ReflectionQuery> random_reflection_queries(int count, unsigned seed, double smallest_cos_view) {
  std::vector<ReflectionQuery> queries;
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = from_pole({0, 1, 0}, 2 * uniform(seed, i, 0) - 1, 2 * pi * uniform(seed, i, 1));
    const double cos_view = smallest_cos_view + (1 - smallest_cos_view) * uniform(seed, i, 2);
    queries.push_back({normal, from_pole(normal, cos_view, 2 * pi * uniform(seed, i, 3))});
  }
  return queries;
}

std::vector<ReflectionQuery> sphere_picture_queries(int size) {
  std::vector<ReflectionQuery> queries;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = (2 * column + 1.0) / size - 1, y = 1 - (2 * row + 1.0) / size;
      const double rest = 1 - x * x - y * y;
      const Vec3 normal = rest > 0 ? Vec3{x, y, std::sqrt(rest)} : Vec3{};
      queries.push_back({normal, {0, 0, 1}});
    }
  }
  return queries;
}

}  // namespace welkin
