// Tangents by the MikkTSpace algorithm, which glTF 2.0 (3.7.2.1) prescribes where a file has none.
#pragma once
#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace metamarch {

// What one corner of a triangle has. MikkTSpace's v grows upwards in the image, glTF's downwards.
struct TangentCorner {
    glm::vec3 position;
    glm::vec3 normal; // unit length
    glm::vec2 texCoord;
};

// Corners 3 * i, 3 * i + 1, 3 * i + 2 are triangle i. For each corner the tangent, and in w the sign of the
// bitangent w * cross(normal, tangent). Corners that no triangle with an area in texture space touches get
// (1, 0, 0, 1). Every tangent is finite, whatever the corners are.
//
// Source: M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, appendix A, in the form that
// mikktspace.com makes the standard: triangles without indices, corners welded where all they have is equal,
// groups of triangles round a corner that are connected by edges and turn the same way in texture space, and
// in each group a mean weighted by angles. Of the standard's angular threshold of 180 degrees, which parts
// only tangents that are exactly opposite, nothing is kept.
std::vector<glm::vec4> mikkTangents(std::span<const TangentCorner> corners);

} // namespace metamarch
