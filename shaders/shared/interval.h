// SPDX-License-Identifier: MIT
// The larger and the smaller of two numbers, for intervals of t.
#ifndef METAMARCH_SHARED_INTERVAL_H
#define METAMARCH_SHARED_INTERVAL_H
#include "interop.h"

SHARED_BEGIN

// A comparison and a choice are one instruction on lavapipe, max() is three. No argument is NaN.
SHARED_FN float larger(const float a, const float b) { return a > b ? a : b; }
SHARED_FN float smaller(const float a, const float b) { return a < b ? a : b; }

SHARED_END
#endif
