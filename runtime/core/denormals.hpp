// The arithmetic of threads that trace: floating-point numbers below the smallest normal one are
// zero, as operands and as results. A weight never needs them, and they cost a hundred times a
// multiplication. Set on each thread of ours at its start, never on a caller's; results depend on
// it, so every thread that computes them has it.
#pragma once

#include <xmmintrin.h>

namespace luxodus {

/// For the calling thread, from here on.
inline void flush_denormals() {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, and denormals are zero
}

}  // namespace luxodus
