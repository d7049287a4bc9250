// The invariants that the twins assert.
#pragma once
#include <stdexcept>

namespace metamarch {

// Chosen at compile time: tests check each step, benchmarks time the same loop without.
enum class Invariants { checked, unchecked };

// Throws std::logic_error, naming the invariant, where it is checked and does not hold.
template <Invariants invariants>
void require([[maybe_unused]] const bool holds, [[maybe_unused]] const char* invariant) {
    if constexpr (invariants == Invariants::checked) {
        if (!holds) {
            throw std::logic_error(invariant);
        }
    }
}

} // namespace metamarch
