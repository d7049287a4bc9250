// SPDX-License-Identifier: MIT
// A part of a mesh in its own space, before it is placed in a scene.
#pragma once
#include "metamarch/file/input_file.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace metamarch {

// Each per-vertex array except positions may be empty; otherwise it is as long as positions.
struct MeshGeometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // any length
    std::array<std::vector<glm::vec2>, 4> texCoords;
    std::vector<glm::vec4> colors;
    std::vector<glm::vec4> tangents; // w is the sign of the bitangent
    std::vector<glm::uvec3> triangles;
};

// Throws Error(inputRefused), with a message that starts with `label`, unless every triangle's indices name
// vertices.
void checkIndices(const InputFile& file, const std::string& label, const MeshGeometry& geometry);

// Computes the vertices' tangents by MikkTSpace from a set of texture coordinates that must exist. If a
// vertex's triangles have different tangents, it is split; the new vertices are appended. Indices must have
// been checked.
void addTangents(MeshGeometry& geometry, std::uint32_t texCoordSet);

} // namespace metamarch
