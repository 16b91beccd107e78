#include <welkin/image/z_test.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace welkin {
namespace {

// Means and variances of what is added.
struct Spread {
  double count = 0, sum = 0, squares = 0;
  void add(double value) {
    count += 1;
    sum += value;
    squares += value * value;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
  // The mean's distance from `expected` in its own standard errors.
  double score(double expected) const {
    if (count < 2) return 0;
    const double variance = std::max(0.0, squares / count - mean() * mean());
    return variance > 0 ? (mean() - expected) / std::sqrt(variance / (count - 1)) : 0;
  }
};

double two_sided_probability(double score) { return std::erfc(std::abs(score) / std::numbers::sqrt2); }

enum class Kind { score, exact, fault };
struct Score {
  Kind kind = Kind::score;
  double value = 0;
};

double freedom_of(const MeasuredImage& a) {
  return a.degrees_of_freedom.value_or(std::numeric_limits<double>::infinity());
}

// Floats that were rounded differ by their last bit: half of it, as if it were a standard error.
double rounding(double a, double b) { return 0x1p-24 * std::max(std::abs(a), std::abs(b)); }

Score score_of(const MeasuredImage& a, const MeasuredImage& b, std::size_t i) {
  const double x = a.mean->pixels[i], y = b.mean->pixels[i];
  const double ex = a.standard_error ? a.standard_error->pixels[i] : 0;
  const double ey = b.standard_error ? b.standard_error->pixels[i] : 0;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(ex) || !std::isfinite(ey))
    return {Kind::fault, 0};
  const double vx = ex * ex, vy = ey * ey;
  if (!(vx + vy > 0)) return {std::abs(x - y) <= 4 * rounding(x, y) ? Kind::exact : Kind::fault, 0};
  const double variance = vx + vy + rounding(x, y) * rounding(x, y);
  const double freedom = (vx + vy) * (vx + vy) / (vx * vx / freedom_of(a) + vy * vy / freedom_of(b));
  return {Kind::score, normal_score((x - y) / std::sqrt(variance), freedom)};
}

struct Sums {
  Spread squares, scores;  // over pixels: means over their channels
  std::size_t beyond_2 = 0, beyond_3 = 0;
  double square_sum = 0;
};

void add_score(ZTest& test, Sums& sums, double score, std::size_t pixel, int channel, int width) {
  ++test.count;
  sums.beyond_2 += std::abs(score) > 2;
  sums.beyond_3 += std::abs(score) > 3;
  sums.square_sum += score * score;
  if (std::abs(score) <= std::abs(test.worst_score)) return;
  test.worst_score = score;
  test.worst_x = static_cast<int>(pixel % static_cast<std::size_t>(width));
  test.worst_y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  test.worst_channel = channel;
}

void conclude(ZTest& test, const Sums& sums, double significance) {
  if (test.count > 0) {
    const auto count = static_cast<double>(test.count);
    test.share_beyond_2 = static_cast<double>(sums.beyond_2) / count;
    test.share_beyond_3 = static_cast<double>(sums.beyond_3) / count;
    test.mean_square = sums.square_sum / count;
    test.mean_square_score = sums.squares.score(1);
    test.mean_score = sums.scores.score(0);
    // 1 - (1 - p)^n, without loss for small p.
    const double p = two_sided_probability(test.worst_score);
    test.worst_probability = p < 1 ? -std::expm1(count * std::log1p(-p)) : 1;
  }
  test.equal = test.faults == 0 && test.worst_probability > significance / 2 &&
               two_sided_probability(test.mean_score) > significance / 2;
}

}  // namespace

// Wallace 1959, "Bounds on normal approximations to Student's and the chi-square distributions", his best u:
// z = (8 v + 1) / (8 v + 3) sqrt(v ln(1 + t^2 / v)).
double normal_score(double t, double degrees_of_freedom) {
  const double v = degrees_of_freedom;
  if (!(v < 1e9)) return t;
  return std::copysign((8 * v + 1) / (8 * v + 3) * std::sqrt(v * std::log1p(t * t / v)), t);
}

ZTest z_test(const MeasuredImage& a, const MeasuredImage& b, double significance) {
  assert(a.mean->pixels.size() == b.mean->pixels.size() && a.mean->channels == b.mean->channels);
  ZTest test;
  Sums sums;
  const int channels = a.mean->channels;
  for (std::size_t pixel = 0; pixel < a.mean->pixels.size() / static_cast<std::size_t>(channels); ++pixel) {
    double square = 0, sum = 0, scores = 0;
    for (int c = 0; c < channels; ++c) {
      const Score score =
          score_of(a, b, pixel * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c));
      test.exact += score.kind == Kind::exact;
      test.faults += score.kind == Kind::fault;
      if (score.kind != Kind::score) continue;
      add_score(test, sums, score.value, pixel, c, a.mean->width);
      square += score.value * score.value;
      sum += score.value;
      ++scores;
    }
    if (scores == 0) continue;
    sums.squares.add(square / scores);
    sums.scores.add(sum / scores);
  }
  conclude(test, sums, significance);
  return test;
}

}  // namespace welkin
