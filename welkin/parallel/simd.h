#pragma once
#include <string>
#include <vector>

// Kernels written with Highway (Wassenberg et al.) are compiled once for each instruction set and the best one that
// the machine has is chosen when the program runs. Results of different sets differ in the last bits only.

namespace welkin {

/// Vectors of it are as aligned as the widest registers want.
struct alignas(64) EightDoubles {
  double values[8] = {};
};

/// The instruction sets that this machine has and kernels were compiled for, best first: "AVX3" (AVX-512), "AVX2",
/// "SSE4", "SSSE3", ... The last one, "SCALAR" or "EMU128", needs no vector instructions.
std::vector<std::string> simd_targets();

/// Makes all kernels use one of simd_targets() from now on; "" goes back to the best. Throws Error for another name.
/// Not to be called while kernels run.
void choose_simd_target(const std::string& name);

}  // namespace welkin
