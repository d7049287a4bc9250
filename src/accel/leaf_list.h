// SPDX-License-Identifier: MIT
// Leaves and the triangles that they list, independent of what made them.
#pragma once
#include "metamarch/shared/scene_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

struct LeafList {
    std::vector<Leaf> leaves;                 // indexed by leafId; the boxes tile the lattice
    std::vector<std::uint32_t> leafTriangles; // triangle ids in leaf order; they ascend within a leaf

    std::span<const std::uint32_t> trianglesOf(const Leaf& leaf) const {
        return std::span(leafTriangles).subspan(leaf.firstTriangle, leaf.triangleCount);
    }
};

} // namespace metamarch
