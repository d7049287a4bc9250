// SPDX-License-Identifier: MIT
// Boxes around triangles, for box hierarchies. They are in lattice space and enlarged so that no rounding
// between ray and box can lose a hit.
#pragma once
#include "metamarch/shared/scene_layout.h"

#include <limits>

namespace metamarch {

struct Box {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

    void grow(const Box& other) {
        lo = glm::min(lo, other.lo);
        hi = glm::max(hi, other.hi);
    }
};

// Returns the triangle's box, grown by kBoxMargin.
Box boxOf(const Lattice& lattice, const TriangleRecord& triangle);

// The corners of a box in single precision, rounded outwards.
vec3 lowCorner(const Box& box);
vec3 highCorner(const Box& box);

} // namespace metamarch
