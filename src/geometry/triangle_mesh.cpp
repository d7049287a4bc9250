// SPDX-License-Identifier: MIT
#include "metamarch/geometry/triangle_mesh.h"

#include <limits>

namespace metamarch {

Bounds boundsOf(const TriangleMesh& mesh) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3 position = mesh.positions[triangle[corner]];
            bounds.lo = glm::min(bounds.lo, position);
            bounds.hi = glm::max(bounds.hi, position);
        }
    }
    return bounds;
}

} // namespace metamarch
