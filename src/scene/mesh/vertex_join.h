// SPDX-License-Identifier: MIT
// Joins vertices that an importer has split into one per corner.
#pragma once
#include <assimp/mesh.h>

#include <cstdint>
#include <vector>

namespace metamarch {

struct JoinedVertices {
    std::vector<std::uint32_t> kept;  // the first of each group of equal vertices, in file order
    std::vector<std::uint32_t> group; // indexed by vertex; an index into kept
};

// Joins vertices with equal positions and, if `whole`, also equal normals and texture coordinates. -0 equals
// 0.
JoinedVertices joinVertices(const aiMesh& mesh, bool whole);

// Keeps every vertex separate.
JoinedVertices keepVertices(const aiMesh& mesh);

} // namespace metamarch
