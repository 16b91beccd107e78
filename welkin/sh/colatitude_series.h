#pragma once
#include <complex>
#include <vector>

#include <welkin/sh/batch_fft.h>

namespace welkin {

/// Series in colatitude, of the functions F_m(theta) of batch_lanes orders m of the same parity at once: private to
/// welkin/sh. Rows lie at theta_n = pi (n + 1/2) / rows. On the circle that goes on beyond the poles, P_lm of even m is
/// a cosine series in theta and P_lm of odd m a sine series, with frequencies up to l.
///
/// Cosine sums come from one FFT of length `rows` (Makhoul 1980): with v_j = x_2j, v_(rows-1-j) = x_(2j+1) and V its
/// transform,  sum over n of x_n cos(k theta_n) = (w_k V_k + conj(w_k) V_(rows-k)) / 2,  w_k = exp(-i pi k / 2 rows).
/// Sines reduce to them by sin(k theta_n) = (-1)^n cos((rows - k) theta_n).
class ColatitudeSums {
 public:
  explicit ColatitudeSums(int rows);

  /// Where the value of a row goes, before sums(): batch_lanes real parts and then batch_lanes imaginary parts.
  double* row(int n) { return fft_.at(n % 2 == 0 ? n / 2 : rows_ - 1 - n / 2); }

  /// out[k] = sum over rows of x_n cos(k theta_n), or of x_n sin(k theta_n), for k = 0 .. count - 1, in the layout of
  /// row(); any count. Uses up the rows.
  void sums(bool sines, int count, double* out);

 private:
  int rows_;
  BatchFft fft_;
  std::vector<std::complex<double>> turns_;  // w_k
};

/// The other way.
class ColatitudeValues {
 public:
  explicit ColatitudeValues(int rows);

  /// Makes row(n) = sum over k < count of series[k] cos(k theta_n), or sin(k theta_n). count <= rows.
  void evaluate(bool sines, int count, const double* series);
  const double* row(int n) const { return fft_.at(n % 2 == 0 ? n / 2 : rows_ - 1 - n / 2); }

 private:
  int rows_;
  BatchFft fft_;
  std::vector<std::complex<double>> turns_;
};

/// Takes a map's rows, on which F_m is constant, to the points of a grid with `grid_rows` > max_degree rows, such that
///   integral of F_m P_lm sin theta dtheta = pi / grid_rows * sum over the grid of value * P_lm     for l <= max_degree.
/// F_m sin theta, continued over the circle, is a series that the sums over rows give exactly; its frequencies beyond
/// max_degree meet nothing in P_lm and are dropped; what is left times P_lm has frequencies below 2 grid_rows, so the
/// sum over equal steps is exact.
class PatchRows {
 public:
  PatchRows(int rows, int max_degree, int grid_rows);
  double* row(int n) { return sums_.row(n); }
  /// odd: of the orders.
  void to_grid(bool odd);
  const double* grid_row(int n) const { return values_.row(n); }

 private:
  int max_degree_;
  ColatitudeSums sums_;
  ColatitudeValues values_;
  std::vector<double> widths_;  // 2/pi times the integral of cos k theta over a row, by that at its centre
  std::vector<double> series_, product_;
};

/// The smallest even number >= at_least with no prime factor above 5.
int smooth_row_count(int at_least);

}  // namespace welkin
