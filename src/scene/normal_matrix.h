// SPDX-License-Identifier: MIT
// How transforms act on normals and on a surface's orientation.
#pragma once
#include <glm/glm.hpp>

namespace metamarch {

// Whether the transform turns a surface's front into its back.
bool isMirroring(const glm::dmat4& transform);

// Returns the matrix that transforms normals. It does not preserve their length; it keeps them on their side
// of a mirrored surface. It exists for singular transforms too, but may then map a normal to zero.
glm::dmat3 normalMatrix(const glm::dmat4& transform);

} // namespace metamarch
