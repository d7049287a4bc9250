// Vertices that an importer gave once per corner, shared again.
#pragma once
#include <assimp/mesh.h>

#include <cstdint>
#include <vector>

namespace metamarch {

struct JoinedVertices {
    std::vector<std::uint32_t> kept;  // first of each group of equal vertices, in file order
    std::vector<std::uint32_t> group; // [vertex], into kept
};

// Joins vertices equal in position and, with `whole`, in normal and texture coordinate too; -0 equals 0.
JoinedVertices joinVertices(const aiMesh& mesh, bool whole);

// Every vertex by itself.
JoinedVertices keepVertices(const aiMesh& mesh);

} // namespace metamarch
