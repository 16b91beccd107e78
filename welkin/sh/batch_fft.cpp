#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/sh/batch_fft.cpp"
#include <hwy/foreach_target.h>
// after foreach_target
#include <hwy/highway.h>

#include <welkin/sh/batch_fft.h>

#include <cmath>
#include <complex>
#include <numbers>

// One pass of Stockham's FFT (Van Loan 1992, section 1.7). The length n of the transforms that are left and their
// number s multiply to the whole length; with n1 = n / R, w = exp(-2 pi i / n) and t_k the R-point transform of
// x[q + s (p + j n1)], j = 0 .. R - 1,
//   y[q + s (R p + k)] = w^(p k) t_k      for p < n1, q < s, k < R,
// after which s becomes R s and n becomes n1. Nothing needs to be reordered.

HWY_BEFORE_NAMESPACE();
namespace welkin {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t lanes = BatchFft::batch_lanes, element = 2 * lanes;
using D = hn::CappedTag<double, lanes>;
using V = hn::Vec<D>;

struct Complex {
  V re, im;
};

HWY_INLINE Complex load(const double* at, std::size_t swapped) {
  const D d;
  return {hn::Load(d, at + swapped), hn::Load(d, at + (lanes - swapped))};
}
HWY_INLINE void store(Complex a, double* at, std::size_t swapped) {
  const D d;
  hn::Store(a.re, d, at + swapped);
  hn::Store(a.im, d, at + (lanes - swapped));
}
HWY_INLINE Complex operator+(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Complex operator-(Complex a, Complex b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
HWY_INLINE Complex add_scaled(Complex a, double scale, Complex b) {
  const V s = hn::Set(D(), scale);
  return {hn::MulAdd(s, b.re, a.re), hn::MulAdd(s, b.im, a.im)};
}
HWY_INLINE Complex scaled(double scale, Complex b) {
  const V s = hn::Set(D(), scale);
  return {hn::Mul(s, b.re), hn::Mul(s, b.im)};
}
HWY_INLINE Complex minus_i_times(Complex a) { return {a.im, hn::Neg(a.re)}; }
HWY_INLINE Complex times(Complex a, const double* w) {
  const V c = hn::Set(D(), w[0]), s = hn::Set(D(), w[1]);
  return {hn::NegMulAdd(s, a.im, hn::Mul(c, a.re)), hn::MulAdd(s, a.re, hn::Mul(c, a.im))};
}

// The R-point transforms, in place.
HWY_INLINE void small_transform(Complex (&t)[2]) {
  const Complex a = t[0], b = t[1];
  t[0] = a + b;
  t[1] = a - b;
}
HWY_INLINE void small_transform(Complex (&t)[3]) {
  const Complex sum = t[1] + t[2], turned = minus_i_times(scaled(0.86602540378443865, t[1] - t[2]));
  const Complex middle = add_scaled(t[0], -0.5, sum);
  t[0] = t[0] + sum;
  t[1] = middle + turned;
  t[2] = middle - turned;
}
HWY_INLINE void small_transform(Complex (&t)[4]) {
  const Complex a = t[0] + t[2], b = t[0] - t[2], c = t[1] + t[3], e = minus_i_times(t[1] - t[3]);
  t[0] = a + c;
  t[1] = b + e;
  t[2] = a - c;
  t[3] = b - e;
}
HWY_INLINE void small_transform(Complex (&t)[5]) {
  constexpr double c1 = 0.30901699437494742, c2 = -0.80901699437494742, s1 = 0.95105651629515357,
                   s2 = 0.58778525229247313;
  const Complex a = t[1] + t[4], b = t[2] + t[3], e = minus_i_times(t[1] - t[4]),
                f = minus_i_times(t[2] - t[3]);
  const Complex first = add_scaled(add_scaled(t[0], c1, a), c2, b);
  const Complex second = add_scaled(add_scaled(t[0], c2, a), c1, b);
  const Complex u = add_scaled(scaled(s1, e), s2, f), v = add_scaled(scaled(s2, e), -s1, f);
  t[0] = t[0] + a + b;
  t[1] = first + u;
  t[4] = first - u;
  t[2] = second + v;
  t[3] = second - v;
}

template <int R>
HWY_INLINE void pass(const double* x, double* y, std::size_t n, std::size_t s, const double* twiddles,
                     std::size_t swapped) {
  const std::size_t n1 = n / R;
  for (std::size_t p = 0; p < n1; ++p) {
    for (std::size_t q = 0; q < s; ++q) {
      for (std::size_t part = 0; part < lanes; part += hn::Lanes(D())) {
        Complex t[R];
        HWY_UNROLL(5)
        for (std::size_t j = 0; j < R; ++j) t[j] = load(x + (q + s * (p + j * n1)) * element + part, swapped);
        small_transform(t);
        double* out = y + (q + s * R * p) * element + part;
        store(t[0], out, swapped);
        HWY_UNROLL(5)
        for (std::size_t k = 1; k < R; ++k)
          store(p == 0 ? t[k] : times(t[k], twiddles + 2 * (p * k * s)), out + s * k * element, swapped);
      }
    }
  }
}

// All passes; the result lies in *x. An inverse transform is a forward one with real and imaginary parts exchanged.
void run_passes(const std::vector<int>& radices, const double* twiddles, bool inverse,
                std::vector<EightDoubles>& x, std::vector<EightDoubles>& y) {
  const std::size_t swapped = inverse ? lanes : 0;
  std::size_t n = x.size() / 2, s = 1;
  for (int radix : radices) {
    switch (radix) {
      case 2: pass<2>(x.data()->values, y.data()->values, n, s, twiddles, swapped); break;
      case 3: pass<3>(x.data()->values, y.data()->values, n, s, twiddles, swapped); break;
      case 4: pass<4>(x.data()->values, y.data()->values, n, s, twiddles, swapped); break;
      default: pass<5>(x.data()->values, y.data()->values, n, s, twiddles, swapped); break;
    }
    x.swap(y);
    n /= static_cast<std::size_t>(radix);
    s *= static_cast<std::size_t>(radix);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace welkin
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin {
namespace {

HWY_EXPORT(run_passes);

std::vector<int> small_factors(int n) {
  std::vector<int> factors;
  for (int radix : {5, 3, 4, 2})
    for (; n % radix == 0; n /= radix) factors.push_back(radix);
  if (n > 1) factors.clear();
  return factors;
}

}  // namespace

BatchFft::BatchFft(int length, bool inverse)
    : length_(length), inverse_(inverse), radices_(small_factors(length)) {
  in_.resize(static_cast<std::size_t>(length) * 2);
  if (radices_.empty()) {
    single_ = std::make_unique<RowFft>(length, inverse);
    return;
  }
  out_.resize(in_.size());
  std::vector<double> table;
  table.reserve(static_cast<std::size_t>(length) * 2);
  for (int k = 0; k < length; ++k) {
    const double angle = -2 * std::numbers::pi * k / length;
    table.push_back(std::cos(angle));
    table.push_back(std::sin(angle));
  }
  twiddles_ = std::make_shared<const std::vector<double>>(std::move(table));
}

BatchFft::BatchFft(const BatchFft& other)
    : length_(other.length_),
      inverse_(other.inverse_),
      radices_(other.radices_),
      twiddles_(other.twiddles_),
      in_(other.in_.size()),
      out_(other.out_.size()) {
  if (other.single_) single_ = std::make_unique<RowFft>(length_, inverse_);
}

void BatchFft::transform() {
  if (single_) return transform_lanes();
  HWY_DYNAMIC_DISPATCH(run_passes)(radices_, twiddles_->data(), inverse_, in_, out_);
}

void BatchFft::transform_lanes() {
  std::vector<std::complex<double>> from(length_), to(length_);
  for (int lane = 0; lane < batch_lanes; ++lane) {
    for (int k = 0; k < length_; ++k) from[k] = {at(k)[lane], at(k)[batch_lanes + lane]};
    single_->transform(from.data(), to.data());
    for (int k = 0; k < length_; ++k) {
      at(k)[lane] = to[k].real();
      at(k)[batch_lanes + lane] = to[k].imag();
    }
  }
}

}  // namespace welkin
#endif
