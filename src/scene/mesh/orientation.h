// SPDX-License-Identifier: MIT
// On which side of a line a point lies, without rounding.
#pragma once
#include <glm/glm.hpp>

#include <cmath>

namespace metamarch {

// orientation() without its quick answer.
int exactOrientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

// Returns 1 if c lies to the left of the line from a to b (x to the right, y up), -1 if it lies to the right,
// 0 if it lies on the line or a equals b. Exact for all finite floats.
inline int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    constexpr double kUnit = 0x1p-53; // relative error of one rounded operation
    const double left = (static_cast<double>(a.x) - c.x) * (static_cast<double>(b.y) - c.y);
    const double right = (static_cast<double>(a.y) - c.y) * (static_cast<double>(b.x) - c.x);
    const double determinant = left - right;
    // The bound of the error of these operations (J. R. Shewchuk, "Adaptive Precision Floating-Point
    // Arithmetic and Fast Robust Geometric Predicates", 1997).
    const double bound = (3.0 + 16.0 * kUnit) * kUnit * (std::abs(left) + std::abs(right));
    if (std::abs(determinant) > bound) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exactOrientation(a, b, c);
}

} // namespace metamarch
