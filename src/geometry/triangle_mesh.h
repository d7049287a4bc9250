// Triangles as acceleration structures and judges take them: spans of positions and of vertex indices.
#pragma once
#include <glm/glm.hpp>

#include <span>

namespace metamarch {

// A view: whoever owns the arrays must outlive it. Every index is in range and every position finite.
struct TriangleMesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles; // vertex indices, counter-clockwise seen from the front
};

struct Bounds {
    glm::vec3 lo;
    glm::vec3 hi;
};

// The box around every position that a triangle uses; `lo > hi` on every axis when there is no triangle.
Bounds boundsOf(const TriangleMesh& mesh);

} // namespace metamarch
