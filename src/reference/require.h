// SPDX-License-Identifier: MIT
// The invariants that the twins assert.
#pragma once
#include "metamarch/shared/interop.h"

#include <stdexcept>

namespace metamarch {

// Chosen at compile time: tests check each step, benchmarks time the same loop without.
enum class Invariants { checked, unchecked };

// Throws std::logic_error, naming the invariant, if it is checked and does not hold.
template <Invariants invariants>
void require([[maybe_unused]] const bool holds, [[maybe_unused]] const char* invariant) {
    if constexpr (invariants == Invariants::checked) {
        if (!holds) {
            throw std::logic_error(invariant);
        }
    }
}

// Returns true if at least one axis moved in the ray's direction and none moved back; therefore a march ends.
inline bool movedOn(const ivec3 from, const ivec3 to, const bvec3 upward) {
    int moved = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int forward = upward[axis] ? to[axis] - from[axis] : from[axis] - to[axis];
        if (forward < 0) {
            return false;
        }
        moved += forward;
    }
    return moved > 0;
}

} // namespace metamarch
