#pragma once

namespace welkin::bc6h {

/// The scale on which the encoder measures errors, as a table over halves: s(h) = log(1 + |x|) sign(x) plus 1/512 of
/// the logarithm's own steps (h / 1024 octaves of a half x), so that squared differences add up to the RMSLE and a dark
/// texel in a bright block still counts. h is a half's magnitude, negative for negative x, in [-0x7c00, 0x7bff]; the
/// pointer is to s(0). Strictly increasing.
const float* error_scale();

}  // namespace welkin::bc6h
