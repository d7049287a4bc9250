// SPDX-License-Identifier: MIT
// Builds the tree of lights that shaders/shared/light_tree.h walks.
#pragma once
#include "metamarch/shared/light_node.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

// A light with a place: an emitter, a point light or a spot.
struct PlacedLight {
    std::array<glm::dvec3, 3> corners; // of the emitter; three times the position of a punctual light
    glm::dvec3 axis;                   // unit length: the normal, or where a spot shines
    // Cosines. The light is at its full intensity within `spread` of the axis. It ends at the angle `end`
    // beyond that. An emitter has 1 and 0; a light that shines equally in all directions has a spread of -1.
    double spread = 1.0;
    double end = 0.0;
    bool isTwoSided = false;
    double intensity = 0.0; // W/sr along the axis, above 0
};

struct LightTree {
    std::vector<LightNode> nodes;        // the root is the first; the children of a node are neighbours
    std::vector<std::uint32_t> branches; // [light]; see Emitter::branches
};

// `lights` has at least one entry. A leaf's link names the light by its index.
LightTree makeLightTree(std::span<const PlacedLight> lights);

} // namespace metamarch
