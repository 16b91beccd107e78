#pragma once
#include <complex>
#include <memory>
#include <vector>

namespace welkin {

/// Complex FFT of any length in O(n log n): private to welkin/sh. Lengths whose prime factors are small go to kissfft as
/// they are; the others are written as a convolution with a chirp (Bluestein 1970) of a power of two.
class RowFft {
 public:
  RowFft(int length, bool inverse);
  ~RowFft();
  RowFft(const RowFft&) = delete;
  RowFft& operator=(const RowFft&) = delete;

  /// out[k] = sum over j of in[j] exp(-+ 2 pi i j k / length), not normalised; in and out differ.
  void transform(const std::complex<double>* in, std::complex<double>* out);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace welkin
