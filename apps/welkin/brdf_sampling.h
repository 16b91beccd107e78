#pragma once
#include <string>

namespace welkin {

/// welkin brdf SPEC --sampling: prints what a BRDF for Monte Carlo reflects and how well it is sampled. Throws Error for
/// a SPEC that parse_scatter refuses or a number of samples out of range.
void print_brdf_sampling(const std::string& spec, int samples, bool json);

}  // namespace welkin
