// How transforms carry what is not a point.
#pragma once
#include <glm/glm.hpp>

namespace metamarch {

// Whether the transform turns a surface's front to its back.
bool isMirroring(const glm::dmat4& transform);

// Carries normals, but not their length, and keeps them on their side of a mirrored surface. A singular
// transform has one too, which may flatten a normal to zero.
glm::dmat3 normalMatrix(const glm::dmat4& transform);

} // namespace metamarch
