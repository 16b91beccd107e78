#pragma once

// WELKIN_TARGET_CLONES before a free function makes the compiler build it for several instruction sets and pick one
// when the program is loaded. Nothing but speed and the last bits of rounding depends on which one runs. Empty for
// compilers without it and under sanitizers, whose runtime is not ready when the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(WELKIN_NO_TARGET_CLONES)
#define WELKIN_TARGET_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WELKIN_TARGET_CLONES
#endif
