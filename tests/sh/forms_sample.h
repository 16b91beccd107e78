#pragma once
#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>
#include <span>
#include <string>
#include <string_view>

#include <welkin/sh/forms/document.h>

// Coefficients for the tests of the forms.

namespace welkin {

/// How GoogleTest names a form.
inline void PrintTo(ShForm form, std::ostream* out) { *out << sh_form_name(form); }

/// Nine random coefficients of three channels in [-1, 1], the first of them positive.
inline ShDocument random_document(unsigned seed, int max_degree = 2) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  ShDocument document{ShCoefficients(max_degree, 3), ShQuantity::radiance, "some map.hdr"};
  for (double& value : document.coefficients.values) value = uniform(random);
  for (std::size_t i = 0; i < 3; ++i)
    document.coefficients.values[i] = 1 + std::abs(document.coefficients.values[i]);
  return document;
}

inline ShDocument read_sh_text(std::string_view text, std::optional<ShForm> bare_form = {}) {
  return read_sh({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "file", bare_form);
}

/// The largest difference of two sets of coefficients over the largest of the first; huge when sizes differ.
inline double relative_difference(const ShCoefficients& a, const ShCoefficients& b) {
  if (a.values.size() != b.values.size()) return 1e300;
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference = std::max(difference, std::abs(a.values[i] - b.values[i]));
    largest = std::max(largest, std::abs(a.values[i]));
  }
  return difference / largest;
}

}  // namespace welkin
