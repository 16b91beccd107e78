#include <hwy/highway.h>

#include <welkin/error.h>
#include <welkin/parallel/simd.h>

// Stands for simd.cpp where kernels are compiled for one instruction set only (the web build).

namespace welkin {

std::vector<std::string> simd_targets() { return {HWY_TARGET == HWY_EMU128 ? "EMU128" : "SCALAR"}; }

void choose_simd_target(const std::string& name) {
  if (!name.empty() && name != simd_targets().front())
    throw Error("no vector instructions \"" + name + "\" here");
}

}  // namespace welkin
