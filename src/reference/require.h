// The invariants that the twins assert in every build.
#pragma once
#include <stdexcept>

namespace metamarch {

inline void require(const bool holds, const char* invariant) {
    if (!holds) {
        throw std::logic_error(invariant);
    }
}

} // namespace metamarch
