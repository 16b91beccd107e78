#include <welkin/image/codecs/bc6h/error_scale.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <welkin/image/half.h>

namespace welkin::bc6h {
namespace {

constexpr int most = 0x7c00;  // the magnitude of -infinity, which a signed block can hold

}  // namespace

ErrorScale::ErrorScale(double linear_above) : table_(2 * most + 1) {
  const double per_unit = linear_above > 0 ? 1 / std::max(linear_above, 0.02) : 0;
  for (int h = 0; h <= most; ++h) {
    const double x = h < most ? static_cast<double>(float_from_half(static_cast<std::uint16_t>(h))) : 65536.0;
    const auto value = static_cast<float>(std::log1p(x) + std::log(2.0) / 512 * h / 1024 + per_unit * x);
    table_[static_cast<std::size_t>(most + h)] = value;
    table_[static_cast<std::size_t>(most - h)] = -value;
  }
}

std::shared_ptr<const ErrorScale> error_scale(double linear_above) {
  static const auto logarithmic = std::make_shared<const ErrorScale>();
  return linear_above > 0 ? std::make_shared<const ErrorScale>(linear_above) : logarithmic;
}

}  // namespace welkin::bc6h
