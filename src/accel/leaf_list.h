// Leaves and their triangles, whatever made them.
#pragma once
#include "metamarch/shared/scene_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

struct LeafList {
    std::vector<Leaf> leaves;                 // [leafId]; their boxes tile the lattice
    std::vector<std::uint32_t> leafTriangles; // triangle ids in leaf order, ascending within a leaf

    std::span<const std::uint32_t> trianglesOf(const Leaf& leaf) const {
        return std::span(leafTriangles).subspan(leaf.firstTriangle, leaf.triangleCount);
    }
};

} // namespace metamarch
