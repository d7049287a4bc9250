// SPDX-License-Identifier: MIT
#include "metamarch/scene/normal_matrix.h"

#include <algorithm>
#include <cmath>

namespace metamarch {

bool isMirroring(const glm::dmat4& transform) { return glm::determinant(glm::dmat3(transform)) < 0.0; }

// The cofactor matrix transforms normals even if the linear part is singular and has no inverse. Entries are
// scaled to at most 1, because only directions matter and products of tiny scales would underflow.
glm::dmat3 normalMatrix(const glm::dmat4& transform) {
    glm::dmat3 linear(transform);
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        largest = std::max(
            {largest, std::abs(linear[column].x), std::abs(linear[column].y), std::abs(linear[column].z)});
    }
    if (largest > 0.0) {
        linear /= largest;
    }
    const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    return isMirroring(transform) ? -cofactor : cofactor;
}

} // namespace metamarch
