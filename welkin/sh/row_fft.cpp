#include <welkin/sh/row_fft.h>

#include <kissfft/kissfft.hh>

#include <cmath>
#include <numbers>
#include <optional>

namespace welkin {
namespace {

using Complex = std::complex<double>;

int largest_prime_factor(int n) {
  int largest = 1;
  for (int p = 2; p * p <= n; ++p)
    for (; n % p == 0; n /= p) largest = p;
  return n > 1 ? n : largest;
}

// kissfft takes O(p^2) for a prime factor p.
constexpr int largest_direct_factor = 31;

}  // namespace

// Bluestein: j k = (j^2 + k^2 - (k - j)^2)/2, so with c_j = exp(-+ pi i j^2 / n)
//   out_k = c_k sum over j of (in_j c_j) conj(c_(k-j)),
// a convolution, done by FFTs of a power of two >= 2n - 1.
struct RowFft::Parts {
  int length = 0;
  kissfft<double> forward;
  std::optional<kissfft<double>> backward;
  std::vector<Complex> chirp, filter, work, spectrum;

  Parts(int n, int padded, bool inverse)
      : length(n), forward(static_cast<std::size_t>(padded), padded == n && inverse) {
    if (padded == n) return;
    backward.emplace(static_cast<std::size_t>(padded), true);
    for (int j = 0; j < n; ++j) {
      const long long square = static_cast<long long>(j) * j % (2LL * n);
      chirp.push_back(
          std::polar(1.0, (inverse ? 1 : -1) * std::numbers::pi * static_cast<double>(square) / n));
    }
    work.assign(padded, Complex{});
    for (int j = 0; j < n; ++j) work[j] = work[(padded - j) % padded] = std::conj(chirp[j]);
    filter.resize(padded);
    spectrum.resize(padded);
    forward.transform(work.data(), filter.data());
  }
};

RowFft::RowFft(int length, bool inverse) {
  int padded = length;
  if (largest_prime_factor(length) > largest_direct_factor)
    for (padded = 1; padded < 2 * length - 1;) padded *= 2;
  parts_ = std::make_unique<Parts>(length, padded, inverse);
}

RowFft::~RowFft() = default;

void RowFft::transform(const Complex* in, Complex* out) {
  Parts& p = *parts_;
  if (!p.backward) return p.forward.transform(in, out);
  std::fill(p.work.begin(), p.work.end(), Complex{});
  for (int j = 0; j < p.length; ++j) p.work[j] = in[j] * p.chirp[j];
  p.forward.transform(p.work.data(), p.spectrum.data());
  for (std::size_t k = 0; k < p.spectrum.size(); ++k) p.spectrum[k] *= p.filter[k];
  p.backward->transform(p.spectrum.data(), p.work.data());
  const double scale = 1.0 / static_cast<double>(p.work.size());
  for (int k = 0; k < p.length; ++k) out[k] = scale * p.work[k] * p.chirp[k];
}

}  // namespace welkin
