#include <welkin/image/codecs/bc6h/error_scale.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include <welkin/image/half.h>

namespace welkin::bc6h {
namespace {

constexpr int most = 0x7c00;  // the magnitude of -infinity, which a signed block can hold

std::vector<float> make_table() {
  std::vector<float> table(2 * most + 1);
  for (int h = 0; h <= most; ++h) {
    const double x = h < most ? static_cast<double>(float_from_half(static_cast<std::uint16_t>(h))) : 65536.0;
    const auto value = static_cast<float>(std::log1p(x) + std::log(2.0) / 512 * h / 1024);
    table[static_cast<std::size_t>(most + h)] = value;
    table[static_cast<std::size_t>(most - h)] = -value;
  }
  return table;
}

}  // namespace

const float* error_scale() {
  static const std::vector<float> table = make_table();
  return table.data() + most;
}

}  // namespace welkin::bc6h
