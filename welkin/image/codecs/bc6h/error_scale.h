#pragma once
#include <memory>
#include <vector>

namespace welkin::bc6h {

/// The scale on which the encoder measures errors, as a table over halves: s(h) = log(1 + |x|) sign(x) plus 1/512 of
/// the logarithm's own steps (h / 1024 octaves of a half x), so that squared differences add up to the RMSLE and a dark
/// texel in a bright block still counts. With linear_above = T > 0, x / T is added: values far above T then count by
/// their difference, as light does, not by their ratio; T below 0.02 is 0.02, which keeps the scale within single
/// precision. h is a half's magnitude, negative for negative x, in [-0x7c00, 0x7bff]. Strictly increasing.
class ErrorScale {
 public:
  explicit ErrorScale(double linear_above = 0);
  /// Points to s(0).
  const float* values() const { return table_.data() + table_.size() / 2; }

 private:
  std::vector<float> table_;
};

/// The scale for this linear_above; that for 0 is made once.
std::shared_ptr<const ErrorScale> error_scale(double linear_above = 0);

}  // namespace welkin::bc6h
