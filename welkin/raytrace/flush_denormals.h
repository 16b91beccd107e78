#pragma once
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace welkin {

/// While it lives, denormal floats of this thread are 0, in results and operands: Embree asks for it, and it is what makes
/// a picture's bytes the same whatever the caller's mode was. The old mode comes back after. To be made inside the body of
/// a parallel loop, since the mode belongs to a thread.
class FlushDenormals {
 public:
#if defined(__SSE__)
  FlushDenormals() : before_(_mm_getcsr()) {
    if ((before_ & flush_bits) != flush_bits) _mm_setcsr(before_ | flush_bits);
  }
  ~FlushDenormals() {
    if ((before_ & flush_bits) != flush_bits) _mm_setcsr(before_);
  }
#else
  FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

#if defined(__SSE__)
 private:
  static constexpr unsigned flush_bits = 0x8040;  // FTZ and DAZ
  unsigned before_;
#endif
};

}  // namespace welkin
