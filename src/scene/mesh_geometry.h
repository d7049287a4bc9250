// A part of a mesh in its own space, before it is placed in a scene.
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// Every array of vertices but the positions may be empty; else it is as long.
struct MeshGeometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // of any length
    std::array<std::vector<glm::vec2>, 2> texCoords;
    std::vector<glm::vec4> colors;
    std::vector<glm::vec4> tangents; // w is the sign of the bitangent
    std::vector<glm::uvec3> triangles;
};

// Throws Error(inputRefused), starting with `label`, unless every index of a triangle names a vertex.
void checkIndices(const InputFile& file, const std::string& label, const MeshGeometry& geometry);

// Gives the vertices the tangents of MikkTSpace from a set of texture coordinates that is there. A vertex
// whose triangles have different tangents there becomes several, the new ones behind the others. Indices must
// have been checked.
void addTangents(MeshGeometry& geometry, std::uint32_t texCoordSet);

} // namespace metamarch
