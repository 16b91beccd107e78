#pragma once
#include <memory>
#include <vector>

#include <welkin/parallel/simd.h>
#include <welkin/sh/row_fft.h>

namespace welkin {

/// batch_lanes complex FFTs of the same length side by side, so that every butterfly is a vector operation: private to
/// welkin/sh. Lengths without prime factors above 5 go through Stockham's self-sorting passes of radix 4, 2, 3 and 5;
/// others through RowFft, one lane after the other.
class BatchFft {
 public:
  static constexpr int batch_lanes = 8;

  explicit BatchFft(int length, bool inverse = false);
  /// Another of the same kind, for another thread; shares the table of sines.
  BatchFft(const BatchFft& other);
  BatchFft& operator=(const BatchFft&) = delete;

  /// The numbers to transform, then, after transform(), the results: element k of all lanes is at(k), with
  /// batch_lanes real parts and behind them batch_lanes imaginary parts.
  double* at(int k) { return in_[static_cast<std::size_t>(k) * 2].values; }
  const double* at(int k) const { return in_[static_cast<std::size_t>(k) * 2].values; }

  /// Sum over j of at(j) exp(-+ 2 pi i j k / length), not normalised.
  void transform();

  int length() const { return length_; }

 private:
  void transform_lanes();

  int length_;
  bool inverse_;
  std::vector<int> radices_;                             // empty: RowFft
  std::shared_ptr<const std::vector<double>> twiddles_;  // cos and -sin of 2 pi k / length, in turn
  std::vector<EightDoubles> in_, out_;
  std::unique_ptr<RowFft> single_;
};

}  // namespace welkin
