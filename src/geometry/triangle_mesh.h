// SPDX-License-Identifier: MIT
// Triangles as acceleration structures and reference tracers take them: spans of positions and vertex
// indices.
#pragma once
#include <glm/glm.hpp>

#include <span>

namespace metamarch {

// A view; the owner of the arrays must outlive it. Every index is in range and every position is finite.
struct TriangleMesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles; // vertex indices, counter-clockwise seen from the front
};

struct Bounds {
    glm::vec3 lo;
    glm::vec3 hi;
};

// Returns the box around all positions that triangles use; `lo > hi` on every axis if there are no triangles.
Bounds boundsOf(const TriangleMesh& mesh);

} // namespace metamarch
