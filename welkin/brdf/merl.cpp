#include <welkin/brdf/merl.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <welkin/brdf/ggx.h>
#include <welkin/error.h>

namespace welkin {
namespace {

static_assert(std::endian::native == std::endian::little, "MERL files are little-endian");

constexpr double pi = std::numbers::pi;
constexpr std::array<double, 3> scales = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
constexpr std::size_t header_bytes = 3 * sizeof(std::int32_t);
constexpr int largest_dimension = 1024;

// Continuous cell coordinates: cell i covers [i, i + 1).
struct CellPoint {
  double half = 0, diff = 0, phi = 0;
};

// The view at azimuth 0, the light at `azimuth`. The frame of the half vector is the world turned about z, then about y.
CellPoint cell_point(const MerlShape& shape, double cos_light, double cos_view, double azimuth) {
  const double sin_light = std::sqrt(std::max(0.0, 1 - cos_light * cos_light));
  const double sin_view = std::sqrt(std::max(0.0, 1 - cos_view * cos_view));
  const LocalVec light{sin_light * std::cos(azimuth), sin_light * std::sin(azimuth), cos_light};
  const LocalVec sum{light.x + sin_view, light.y, light.z + cos_view};
  const double across = std::hypot(sum.x, sum.y), size = std::hypot(across, sum.z);
  const double cos_phi = across > 0 ? sum.x / across : 1, sin_phi = across > 0 ? sum.y / across : 0;
  const double cos_half = sum.z / size, sin_half = across / size;
  const double along =
      cos_phi * light.x + sin_phi * light.y;  // of the light, in the half vector's vertical plane
  const double x = cos_half * along - sin_half * light.z;
  const double y = cos_phi * light.y - sin_phi * light.x;
  const double theta_half = std::atan2(across, sum.z);
  const double theta_diff = std::atan2(std::hypot(x, y), sin_half * along + cos_half * light.z);
  const double phi = std::atan2(y, x);
  return {shape.theta_half * std::sqrt(theta_half / (pi / 2)), shape.theta_diff * theta_diff / (pi / 2),
          shape.phi_diff * (phi < 0 ? phi + pi : phi) / pi};
}

// The pair of directions at a cell's centre, as the arguments of IsotropicBrdf::value; a cosine <= 0 is below the surface.
struct Pair {
  double cos_light = 0, cos_view = 0, azimuth = 0;
};

Pair cell_centre(const MerlShape& shape, int half, int diff, int phi) {
  const double root = (half + 0.5) / shape.theta_half;
  const double theta_half = pi / 2 * root * root;
  const double theta_diff = pi / 2 * (diff + 0.5) / shape.theta_diff;
  const double phi_diff = pi * (phi + 0.5) / shape.phi_diff;
  const double c = std::cos(theta_half), s = std::sin(theta_half);
  const double x = std::sin(theta_diff) * std::cos(phi_diff), y = std::sin(theta_diff) * std::sin(phi_diff);
  const double z = std::cos(theta_diff);
  const LocalVec light{c * x + s * z, y, c * z - s * x}, view{s * z - c * x, -y, c * z + s * x};
  const double turn = std::atan2(light.x * view.y - light.y * view.x, light.x * view.x + light.y * view.y);
  return {std::min(light.z, 1.0), std::min(view.z, 1.0), std::abs(turn)};
}

std::int32_t read_int32(const std::uint8_t* bytes) {
  std::int32_t value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

MerlShape read_shape(std::span<const std::uint8_t> bytes, std::string_view name) {
  if (bytes.size() < header_bytes)
    throw Error(name, fmt::format("{} bytes are too few for a MERL file", bytes.size()));
  const std::array<std::int32_t, 3> n = {read_int32(bytes.data()), read_int32(bytes.data() + 4),
                                         read_int32(bytes.data() + 8)};
  for (std::int32_t count : n)
    if (count < 1 || count > largest_dimension)
      throw Error(
          name, fmt::format("not a MERL file: its first numbers, {} x {} x {}, are no dimensions (a file of "
                            "the database has 90 x 90 x 180)",
                            n[0], n[1], n[2]));
  const MerlShape shape{n[0], n[1], n[2]};
  const std::size_t expected = header_bytes + 3 * shape.cells() * sizeof(double);
  if (bytes.size() != expected)
    throw Error(name, fmt::format("{} bytes, where a MERL file of {} x {} x {} has {}", bytes.size(), n[0],
                                  n[1], n[2], expected));
  return shape;
}

// Averages phi_diff and pi - phi_diff, the cells k and n - 1 - k; where one of the two is invalid, the other is taken.
void make_symmetric(MerlTable& table) {
  const int n = table.shape.phi_diff;
  for (std::size_t row = 0; row < table.values.size(); row += static_cast<std::size_t>(n)) {
    for (int k = 0; k < (n + 1) / 2; ++k) {
      float &a = table.values[row + k], &b = table.values[row + n - 1 - k];
      const float mean = a < 0 ? b : b < 0 ? a : (a + b) / 2;
      a = b = mean;
    }
  }
}

// A pair of neighbours along one axis and the share of the second.
struct Between {
  int first = 0, second = 0;
  double share = 0;
};

Between between_centres(double coordinate, int count, bool periodic) {
  const double at = periodic ? coordinate - 0.5 : std::clamp(coordinate - 0.5, 0.0, count - 1.0);
  const double floor = std::floor(at);
  const int first = static_cast<int>(floor), second = first + 1;
  if (periodic) return {(first + count) % count, second % count, at - floor};
  return {first, std::min(second, count - 1), at - floor};
}

std::array<double, 3> look_up(const MerlTable& table, const CellPoint& point) {
  const MerlShape& n = table.shape;
  const Between half = between_centres(point.half, n.theta_half, false);
  const Between diff = between_centres(point.diff, n.theta_diff, false);
  const Between phi = between_centres(point.phi, n.phi_diff, true);
  std::array<double, 3> sum{}, weights{};
  for (int corner = 0; corner < 8; ++corner) {
    const bool h = corner & 1, d = corner & 2, p = corner & 4;
    const double weight = (h ? half.share : 1 - half.share) * (d ? diff.share : 1 - diff.share) *
                          (p ? phi.share : 1 - phi.share);
    const std::size_t row = static_cast<std::size_t>(h ? half.second : half.first) * n.theta_diff +
                            (d ? diff.second : diff.first);
    const std::size_t cell = row * n.phi_diff + (p ? phi.second : phi.first);
    for (int c = 0; c < 3; ++c) {
      const double value = table.values[c * n.cells() + cell];
      if (value < 0) continue;
      sum[c] += weight * value;
      weights[c] += weight;
    }
  }
  for (int c = 0; c < 3; ++c) sum[c] = weights[c] > 0 ? sum[c] / weights[c] : 0;
  return sum;
}

// Twice the theta_half at which the value at theta_diff = 0 has fallen to half of its peak, never below a cell.
double width_of(const IsotropicBrdf& brdf, const MerlShape& shape) {
  const auto green = [&](double theta_half) {
    return brdf.value(std::cos(theta_half), std::cos(theta_half), 0)[1];
  };
  const double peak = green(0);
  for (int i = 1; i < shape.theta_half; ++i) {
    const double root = (i + 0.5) / shape.theta_half, theta_half = pi / 2 * root * root;
    if (green(theta_half) < peak / 2) return std::min(1.0, 2 * theta_half);
  }
  return 1;
}

}  // namespace

MerlTable read_merl(std::span<const std::uint8_t> bytes, std::string_view name) {
  MerlTable table{read_shape(bytes, name), {}};
  const std::size_t cells = table.shape.cells();
  table.values.resize(3 * cells);
  for (std::size_t i = 0; i < 3 * cells; ++i) {
    double value;
    std::memcpy(&value, bytes.data() + header_bytes + i * sizeof value, sizeof value);
    value *= scales[i / cells];
    if (!(value <= 1e30 && value >= -1e30))
      throw Error(name, fmt::format("number {} of the {} plane is not finite or beyond 1e30", i % cells,
                                    std::array{"red", "green", "blue"}[i / cells]));
    table.values[i] = value < 0 ? -1.0f : static_cast<float>(value);
  }
  return table;
}

std::vector<std::uint8_t> encode_merl(const MerlTable& table) {
  const std::size_t cells = table.shape.cells();
  std::vector<std::uint8_t> bytes(header_bytes + 3 * cells * sizeof(double));
  const std::array<std::int32_t, 3> n = {table.shape.theta_half, table.shape.theta_diff,
                                         table.shape.phi_diff};
  std::memcpy(bytes.data(), n.data(), header_bytes);
  for (std::size_t i = 0; i < 3 * cells; ++i) {
    const double value = table.values[i] < 0 ? -1 : table.values[i] / scales[i / cells];
    std::memcpy(bytes.data() + header_bytes + i * sizeof value, &value, sizeof value);
  }
  return bytes;
}

MerlTable tabulate_merl(const IsotropicBrdf& brdf, const MerlShape& shape) {
  MerlTable table{shape, std::vector<float>(3 * shape.cells(), -1.0f)};
  std::size_t cell = 0;
  for (int half = 0; half < shape.theta_half; ++half)
    for (int diff = 0; diff < shape.theta_diff; ++diff)
      for (int phi = 0; phi < shape.phi_diff; ++phi, ++cell) {
        const Pair pair = cell_centre(shape, half, diff, phi);
        if (pair.cos_light <= 0 || pair.cos_view <= 0) continue;
        const auto value = brdf.value(pair.cos_light, pair.cos_view, pair.azimuth);
        for (int c = 0; c < 3; ++c) table.values[c * shape.cells() + cell] = static_cast<float>(value[c]);
      }
  return table;
}

IsotropicBrdf make_merl_brdf(const MerlTable& table, std::string_view name) {
  auto symmetric = std::make_shared<MerlTable>(table);
  make_symmetric(*symmetric);
  IsotropicBrdf brdf;
  brdf.name = "merl " + std::string(name);
  brdf.value = [shared = std::shared_ptr<const MerlTable>(symmetric)](double cos_light, double cos_view,
                                                                      double azimuth) {
    return look_up(*shared, cell_point(shared->shape, cos_light, cos_view, azimuth));
  };
  brdf.angular_width = width_of(brdf, table.shape);
  return brdf;
}

}  // namespace welkin
