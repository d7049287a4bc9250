// SPDX-License-Identifier: MIT
// Tangents by the MikkTSpace algorithm, which glTF 2.0 (3.7.2.1) prescribes for files without tangents.
#pragma once
#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace metamarch {

// One corner of a triangle. MikkTSpace's v grows upwards in the image, glTF's downwards.
struct TangentCorner {
    glm::vec3 position;
    glm::vec3 normal; // unit length
    glm::vec2 texCoord;
};

// Triangle i has the corners 3 * i, 3 * i + 1 and 3 * i + 2. Returns for each corner the tangent and, in w,
// the sign of the bitangent w * cross(normal, tangent). Corners that touch no triangle with an area in
// texture space get (1, 0, 0, 1). Every tangent is finite, whatever the corners are.
//
// Source: M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, appendix A, in the form that
// mikktspace.com defines as the standard: triangles are unindexed; corners with equal attributes are welded;
// the triangles around a corner form groups that are connected by edges and have the same orientation in
// texture space; each group gets a mean weighted by angles. The standard's angular threshold of 180 degrees
// is left out: it would separate only tangents that are exactly opposite.
std::vector<glm::vec4> mikkTangents(std::span<const TangentCorner> corners);

} // namespace metamarch
