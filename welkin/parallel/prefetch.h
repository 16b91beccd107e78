#pragma once

namespace welkin {

/// Asks for the memory at this address, which need not be valid: what is read a little later is there by then.
/// The empty statement keeps it: GCC takes functions that do nothing but prefetch for ones without effect and drops calls
/// of them.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
  __asm__ volatile("");
#else
  static_cast<void>(address);
#endif
}

}  // namespace welkin
