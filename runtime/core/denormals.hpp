// Floating-point mode of threads that trace: denormal numbers are treated as zero, as operands and
// as results. A weight never needs them, and they cost a hundred times a multiplication. Each
// thread of ours sets it at its start; a caller's thread is left alone. Results depend on the mode,
// so every thread that computes them sets it. Affects the calling thread only.
#pragma once

#include <xmmintrin.h>

namespace luxodus {

/// Sets the mode of the calling thread.
inline void flush_denormals() {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, and denormals are zero
}

}  // namespace luxodus
