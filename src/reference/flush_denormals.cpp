#include "reference/trace.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace metamarch {

#if defined(__SSE__)
// Flush to zero (bit 15) and denormals are zero (bit 6) of the SSE control register.
FlushDenormals::FlushDenormals() : saved(_mm_getcsr()) { _mm_setcsr(saved | 0x8040u); }
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved); }
#else
// Elsewhere lavapipe keeps denormals, and so does this.
FlushDenormals::FlushDenormals() : saved(0) {}
FlushDenormals::~FlushDenormals() = default;
#endif

} // namespace metamarch
