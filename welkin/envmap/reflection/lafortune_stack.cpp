#include <welkin/envmap/reflection/lafortune_stack.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/filter.h>
#include <welkin/error.h>
#include <welkin/sphere/cube_lookup.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int diffuse_size = 16;  // irradiance: bilinear look-up within 5e-4 of its largest value

// cos^N varies over 1 / sqrt(N): four texels in that, of the pi / 2 that a face spans.
int size_for(double exponent) {
  int size = 4;
  while (size < 2048 && size < 4 * std::sqrt(exponent)) size *= 2;
  return size;
}

void check(const LafortuneStackOptions& options) {
  if (!(options.largest_exponent >= 1 && options.largest_exponent <= 65536))
    throw Error(
        fmt::format("the largest exponent must lie in [1, 65536], not {:g}", options.largest_exponent));
  if (options.size != 0 && (options.size < 4 || options.size > 2048))
    throw Error(fmt::format("the size of a stack must lie in [4, 2048], not {}", options.size));
}

std::vector<double> exponent_row(double largest) {
  std::vector<double> exponents;
  for (double n = largest; n >= 1; n /= 4) exponents.push_back(n);
  exponents.push_back(0);
  return exponents;
}

LocalVec to_local(Vec3 d, Vec3 x, Vec3 y, Vec3 z) { return {dot(d, x), dot(d, y), dot(d, z)}; }

Vec3 any_tangent(Vec3 normal) {
  return normalized(cross(normal, std::abs(normal.y) < 0.7 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
}

void add_lobe(const LafortuneStack& stack, const LafortuneLobe& lobe, const TangentQuery& query,
              Vec3 bitangent, LocalVec view, std::array<double, 3>& sum) {
  const LocalVec axis = lobe.axis(view);
  const double size = std::sqrt(dot(axis, axis));
  if (axis.z <= 0) return;  // n.r = 0 and below
  const Vec3 world = axis.x * query.tangent + axis.y * bitangent + axis.z * query.normal;
  float filtered[3];
  look_up_cube(stack.glossy, world, lafortune_level(stack, lobe.exponent), filtered);
  // The levels are normalised: times the integral of cos^N, 2 pi / (N + 1).
  const double factor =
      (lobe.exponent + 2) / (lobe.exponent + 1) * std::pow(size, lobe.exponent) * axis.z / size;
  for (int c = 0; c < 3; ++c) sum[c] += factor * lobe.scale[c] * static_cast<double>(filtered[c]);
}

}  // namespace

LafortuneStack prepare_lafortune_stack(const Image& radiance, const LafortuneStackOptions& options) {
  check(options);
  LafortuneStack stack;
  stack.exponents = exponent_row(options.largest_exponent);
  const int size = options.size > 0 ? options.size : size_for(options.largest_exponent);
  std::vector<FilterTarget> targets;
  for (std::size_t k = 0; k < stack.exponents.size(); ++k)
    targets.push_back({make_phong_kernel(stack.exponents[k]), std::max(1, size >> k)});
  targets.push_back({make_lambert_kernel(), diffuse_size});
  stack.glossy.levels = filter_environment(radiance, targets);
  stack.diffuse = std::move(stack.glossy.levels.back());
  stack.glossy.levels.pop_back();
  return stack;
}

// The mean of 1 - cos under cos^N is 1 / (N + 2).
double lafortune_level(const LafortuneStack& stack, double exponent) {
  const std::vector<double>& row = stack.exponents;
  for (std::size_t k = 0; k + 1 < row.size(); ++k) {
    if (exponent < row[k + 1]) continue;
    if (exponent >= row[k]) return static_cast<double>(k);
    const double from = 1 / (row[k] + 2), to = 1 / (row[k + 1] + 2);
    return static_cast<double>(k) + (1 / (exponent + 2) - from) / (to - from);
  }
  return static_cast<double>(row.size() - 1);
}

std::array<double, 3> reflect(const LafortuneStack& stack, const LafortuneBrdf& brdf,
                              const TangentQuery& query) {
  std::array<double, 3> sum{};
  const Vec3 bitangent = cross(query.normal, query.tangent);
  const LocalVec view = to_local(query.view, query.tangent, bitangent, query.normal);
  if (view.z <= 0) return sum;
  float diffuse[3];
  look_up_cube(stack.diffuse, query.normal, diffuse);
  for (int c = 0; c < 3; ++c) sum[c] = brdf.diffuse_albedo[c] * static_cast<double>(diffuse[c]);
  for (const LafortuneLobe& lobe : brdf.lobes) add_lobe(stack, lobe, query, bitangent, view, sum);
  return sum;
}

std::array<double, 3> reflect(const LafortuneStack& stack, const LafortuneBrdf& brdf,
                              const ReflectionQuery& query) {
  return reflect(stack, brdf, TangentQuery{query.normal, any_tangent(query.normal), query.view});
}

// A different turn for each query, by the golden angle.
std::vector<TangentQuery> with_tangents(std::span<const ReflectionQuery> queries) {
  std::vector<TangentQuery> turned;
  for (const ReflectionQuery& query : queries) {
    const double angle = static_cast<double>(turned.size()) * pi * (3 - std::sqrt(5.0));
    const Vec3 x = any_tangent(query.normal), y = cross(query.normal, x);
    turned.push_back({query.normal, std::cos(angle) * x + std::sin(angle) * y, query.view});
  }
  return turned;
}

StackFiles stack_files(const LafortuneStack& stack) {
  StackFiles files;
  files.cubes.push_back({"glossy", stack.glossy});
  files.cubes.push_back({"diffuse", {{stack.diffuse}}});
  files.json = fmt::format(
      "{{\n  \"method\": \"lafortune\",\n  \"glossy\": {{\"kernel\": \"phong\", \"exponents\": [{:g}]}},\n"
      "  \"diffuse\": \"irradiance_over_pi\",\n  \"lookup\": {}\n}}\n",
      fmt::join(stack.exponents, ", "),
      json_string(
          "r = (Cx vx, Cy vy, Cz vz); scale (N + 2) / (N + 1) |r|^N (n.r / |r|) glossy(r, level); between "
          "levels 1 / (N + 2) is linear"));
  return files;
}

}  // namespace welkin
