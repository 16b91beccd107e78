#include <welkin/sh/colatitude_series.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/parallel/target_clones.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;
constexpr int lanes = BatchFft::batch_lanes, element = 2 * lanes;

std::vector<Complex> quarter_turns(int rows) {
  std::vector<Complex> turns(rows + 1);
  for (int k = 0; k <= rows; ++k) turns[k] = std::polar(1.0, -0.5 * std::numbers::pi * k / rows);
  return turns;
}

// out = (u a + v b) / 2 for all lanes.
WELKIN_TARGET_CLONES void combine(Complex u, const double* __restrict a, Complex v,
                                  const double* __restrict b, double* __restrict out) {
  const double ur = 0.5 * u.real(), ui = 0.5 * u.imag(), vr = 0.5 * v.real(), vi = 0.5 * v.imag();
  for (int i = 0; i < lanes; ++i) {
    out[i] = ur * a[i] - ui * a[i + lanes] + vr * b[i] - vi * b[i + lanes];
    out[i + lanes] = ur * a[i + lanes] + ui * a[i] + vr * b[i + lanes] + vi * b[i];
  }
}

void negate(double* at) {
  for (int i = 0; i < element; ++i) at[i] = -at[i];
}

// A frequency beyond `rows` looks the same on the rows as one in [0, rows], up to its sign.
struct Alias {
  int k = 0;
  double sign = 1;
};

Alias alias(int k, int rows, bool sines) {
  Alias found{k % (4 * rows), 1};
  if (found.k > 2 * rows) found = {4 * rows - found.k, sines ? -1.0 : 1.0};
  if (found.k > rows) found = {2 * rows - found.k, sines ? found.sign : -found.sign};
  return found;
}

}  // namespace

ColatitudeSums::ColatitudeSums(int rows) : rows_(rows), fft_(rows), turns_(quarter_turns(rows)) {}

void ColatitudeSums::sums(bool sines, int count, double* out) {
  if (sines)
    for (int n = 1; n < rows_; n += 2) negate(row(n));
  fft_.transform();
  for (int k = 0; k < count; ++k) {
    const Alias a = alias(k, rows_, sines);
    const int j = sines ? rows_ - a.k : a.k;
    combine(a.sign * turns_[j], fft_.at(j % rows_), a.sign * std::conj(turns_[j]),
            fft_.at((rows_ - j) % rows_), out + static_cast<std::size_t>(k) * element);
  }
}

ColatitudeValues::ColatitudeValues(int rows) : rows_(rows), fft_(rows, true), turns_(quarter_turns(rows)) {}

// x_n = sum over k of c_k cos(k theta_n) is, in the order of v, the inverse transform of
// (conj(w_k) c_k + w_(rows-k) c_(rows-k)) / 2, c_0 for k = 0.
void ColatitudeValues::evaluate(bool sines, int count, const double* series) {
  assert(count <= rows_);
  static const double nothing[element] = {};
  const auto cosine_term = [&](int k) {
    const int j = sines ? rows_ - k : k;
    const bool given = j < count && !(sines && j == 0);
    return given ? series + static_cast<std::size_t>(j) * element : nothing;
  };
  std::copy_n(cosine_term(0), element, fft_.at(0));
  for (int k = 1; k < rows_; ++k)
    combine(std::conj(turns_[k]), cosine_term(k), turns_[rows_ - k], cosine_term(rows_ - k), fft_.at(k));
  fft_.transform();
  if (sines)
    for (int n = 1; n < rows_; n += 2) negate(fft_.at(rows_ - 1 - n / 2));
}

PatchRows::PatchRows(int rows, int max_degree, int grid_rows)
    : max_degree_(max_degree), sums_(rows), values_(grid_rows), widths_(max_degree + 2) {
  assert(grid_rows > max_degree);
  for (int k = 0; k < static_cast<int>(widths_.size()); ++k) {
    const double half = 0.5 * std::numbers::pi / rows;
    widths_[k] = 2 / std::numbers::pi * (k > 0 ? 2 * std::sin(k * half) / k : 2 * half);
  }
  series_.resize(widths_.size() * element);
  product_.resize(series_.size());
}

// Continued beyond the poles, F_m sin theta has the parity of P_lm, so F_m alone has the other one:
//   even m: F = sum b_k sin k theta, F sin theta = sum (b_(k+1) - b_(k-1))/2 cos k theta,
//   odd m:  F = a_0/2 + sum a_k cos k theta, F sin theta = sum (a_(k-1) - a_(k+1))/2 sin k theta.
void PatchRows::to_grid(bool odd) {
  sums_.sums(!odd, max_degree_ + 2, series_.data());
  for (int k = 0; k < max_degree_ + 2; ++k)
    for (int i = 0; i < element; ++i) series_[static_cast<std::size_t>(k) * element + i] *= widths_[k];
  const double sign = odd ? -0.5 : 0.5;
  for (int k = 0; k <= max_degree_; ++k) {
    const double* next = series_.data() + static_cast<std::size_t>(k + 1) * element;
    const double* before = k > 0 ? next - 2 * element : nullptr;
    double* to = product_.data() + static_cast<std::size_t>(k) * element;
    for (int i = 0; i < element; ++i) to[i] = sign * (next[i] - (before ? before[i] : 0.0));
  }
  values_.evaluate(odd, max_degree_ + 1, product_.data());
}

int smooth_row_count(int at_least) {
  const auto is_smooth = [](int n) {
    for (int p : {2, 3, 5})
      while (n % p == 0) n /= p;
    return n == 1;
  };
  int rows = std::max(2, at_least + at_least % 2);
  while (!is_smooth(rows)) rows += 2;
  return rows;
}

}  // namespace welkin
