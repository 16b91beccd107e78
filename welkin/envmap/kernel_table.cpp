#include <welkin/envmap/kernel_table.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr std::size_t most_knots = 100000;
constexpr std::size_t largest_file = std::size_t{16} << 20;
constexpr double largest_value = 1e30, closest_angles = 1e-12;
constexpr double narrowest = 1e-4;  // radians, as of the kernels in closed form

// Fritsch & Carlson 1980 with the weighted harmonic mean of Fritsch & Butland 1984: no slope where the values turn, so
// the cubic between two knots is monotone.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t last = x.size() - 1;
  std::vector<double> secants(last), slopes(last + 1);
  for (std::size_t i = 0; i < last; ++i) secants[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  slopes[last] = secants[last - 1];
  for (std::size_t i = 1; i < last; ++i) {
    if (secants[i - 1] * secants[i] <= 0) continue;
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double a = 2 * after + before, b = after + 2 * before;
    slopes[i] = (a + b) / (a / secants[i - 1] + b / secants[i]);
  }
  return slopes;
}

// Of the rectangle that is as high as the table's largest value, and has its area.
double equivalent_width(std::span<const double> x, std::span<const double> y) {
  double area = 0;
  for (std::size_t i = 1; i < x.size(); ++i) area += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
  return area / *std::max_element(y.begin(), y.end());
}

bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

// Takes the next number of a line; false at its end, Error at anything else.
bool take_number(std::string_view& line, double& number, const std::string& place) {
  while (!line.empty() && is_separator(line.front())) line.remove_prefix(1);
  if (line.empty()) return false;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  const std::size_t used = static_cast<std::size_t>(end - line.data());
  if (error != std::errc() || (used < line.size() && !is_separator(line[used])))
    throw Error(place + "expected an angle in degrees and a value");
  line.remove_prefix(used);
  return true;
}

}  // namespace

double KernelTable::evaluate(double angle) const {
  if (!(angle <= angles.back())) return 0;
  const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  const std::size_t i = static_cast<std::size_t>(after - angles.begin()) - 1;
  const double width = angles[i + 1] - angles[i], t = std::max(0.0, (angle - angles[i]) / width);
  const double s = 1 - t;
  const double value = s * s * ((1 + 2 * t) * values[i] + t * width * slopes[i]) +
                       t * t * ((1 + 2 * s) * values[i + 1] - s * width * slopes[i + 1]);
  return std::max(0.0, value);
}

KernelTable make_kernel_table(std::span<const double> angles_radians, std::span<const double> values) {
  if (angles_radians.size() != values.size()) throw Error("a kernel table needs as many values as angles");
  if (values.size() < 2 || values.size() > most_knots)
    throw Error(fmt::format("a kernel table needs 2 to {} lines, not {}", most_knots, values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 ? angles_radians[0] != 0 : !(angles_radians[i] > angles_radians[i - 1] + closest_angles))
      throw Error("the angles of a kernel table must rise from 0, each larger than the one before");
    if (!(values[i] >= 0 && values[i] <= largest_value))
      throw Error("the values of a kernel table must lie in [0, 1e30]");
  }
  if (angles_radians.back() > std::numbers::pi * (1 + 1e-12))
    throw Error("the angles of a kernel table must not exceed 180 degrees");
  if (*std::max_element(values.begin(), values.end()) < 1e-30)
    throw Error("a kernel table must not be all zero");
  if (equivalent_width(angles_radians, values) < narrowest)
    throw Error("the kernel of this table is narrower than 0.0001 radians");
  KernelTable table{{angles_radians.begin(), angles_radians.end()}, {values.begin(), values.end()}, {}};
  table.slopes = monotone_slopes(table.angles, table.values);
  return table;
}

KernelTable parse_kernel_table(std::string_view text, std::string_view name) {
  std::vector<double> angles, values;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, line.find('#'));
    const std::string place = fmt::format("{}, line {}: ", name, number);
    double angle = 0, value = 0, more = 0;
    if (!take_number(line, angle, place)) continue;
    if (!take_number(line, value, place)) throw Error(place + "the angle has no value beside it");
    if (take_number(line, more, place)) throw Error(place + "more than an angle and a value");
    if (!(angle <= 180)) throw Error(place + "the angle is above 180 degrees");
    angles.push_back(angle * std::numbers::pi / 180);
    values.push_back(value);
    if (angles.size() > most_knots) throw Error(fmt::format("{}: more than {} lines", name, most_knots));
  }
  if (!values.empty() && values.back() > 0 && angles.back() < std::numbers::pi * (1 - 1e-9))
    throw Error(
        fmt::format("{}: the last value must be 0 (or stand at 180 degrees): a lobe with a hard edge cannot "
                    "be integrated well",
                    name));
  try {
    return make_kernel_table(angles, values);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()));
  }
}

KernelTable load_kernel_table(std::string_view path) {
  std::ifstream file{std::string(path), std::ios::binary};
  std::string text(largest_file + 1, '\0');
  if (file) file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad() || file.gcount() == 0) throw Error(fmt::format("{}: cannot be read, or is empty", path));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > largest_file)
    throw Error(fmt::format("{}: larger than 16 MiB, not a kernel table", path));
  return parse_kernel_table(text, path);
}

}  // namespace welkin
