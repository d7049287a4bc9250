// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/orientation.h"

#include <array>

namespace metamarch {
namespace {

constexpr int signOf(double value) { return (value > 0.0) - (value < 0.0); }

// Adds `value` to a sum that is held without rounding as non-overlapping parts, the smallest first
// (GROW-EXPANSION in J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", 1997).
template <std::size_t N>
void grow(std::array<double, N>& parts, std::size_t& count, double value) {
    for (std::size_t i = 0; i < count; ++i) {
        const double sum = value + parts[i];
        const double virtualPart = sum - value;
        const double error = (value - (sum - virtualPart)) + (parts[i] - virtualPart);
        parts[i] = error;
        value = sum;
    }
    parts[count++] = value;
}

} // namespace

// The product of two floats is exact in a double, and so is the sum of the determinant's six products in
// parts.
int exactOrientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    std::array<double, 6> parts{};
    std::size_t count = 0;
    for (const double product : {a.x * b.y, -a.y * b.x, b.x * c.y, -b.y * c.x, c.x * a.y, -c.y * a.x}) {
        grow(parts, count, product);
    }
    for (std::size_t i = count; i-- > 0;) {
        if (parts[i] != 0.0) { // the largest part outweighs all others
            return signOf(parts[i]);
        }
    }
    return 0;
}

} // namespace metamarch
