// SPDX-License-Identifier: MIT
#include "accel/overlap.h"

#include <algorithm>
#include <array>

namespace metamarch::tests {
namespace {

using Vector = glm::vec<3, long double>;

bool separates(const Vector& axis, const std::array<Vector, 3>& corners, const Vector& halfSize) {
    const long double radius = glm::dot(glm::abs(axis), halfSize);
    const auto [lo, hi] =
        std::minmax({glm::dot(axis, corners[0]), glm::dot(axis, corners[1]), glm::dot(axis, corners[2])});
    return lo > radius || hi < -radius;
}

} // namespace

bool overlaps(const LatticeTriangle& triangle, const Box& box) {
    const Vector center = (Vector(box.lo) + Vector(box.hi)) / 2.0L;
    const Vector halfSize = (Vector(box.hi) - Vector(box.lo)) / 2.0L;
    const std::array<Vector, 3> corners = {Vector(triangle[0]) - center, Vector(triangle[1]) - center,
                                           Vector(triangle[2]) - center};
    const std::array<Vector, 3> edges = {corners[1] - corners[0], corners[2] - corners[1],
                                         corners[0] - corners[2]};
    if (separates(glm::cross(edges[0], edges[1]), corners, halfSize)) {
        return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
        Vector unit(0.0L);
        unit[axis] = 1.0L;
        if (separates(unit, corners, halfSize)) {
            return false;
        }
        for (const Vector& edge : edges) {
            if (separates(glm::cross(unit, edge), corners, halfSize)) {
                return false;
            }
        }
    }
    return true;
}

Box grown(const CellRange& cells, const glm::dvec3& margin) {
    return {glm::dvec3(cells.lo[0], cells.lo[1], cells.lo[2]) - margin,
            glm::dvec3(cells.hi[0], cells.hi[1], cells.hi[2]) + 1.0 + margin};
}

} // namespace metamarch::tests
