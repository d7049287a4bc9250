// The meta table: for every cell of the lattice the leaf it belongs to, and how far a ray may go from there.
#pragma once
#include "shared/scene_layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace metamarch {

struct MetaTable {
    std::vector<Leaf> leaves;              // [leafId], each with its exit box
    std::vector<std::uint32_t> leafOfCell; // [cellIndex]
    std::vector<TriangleRecord> triangles; // in the order of its leaves, where these are not the kd-tree's
};

// The table over leaves that tile a lattice of `resolution` cells. Their boxes are their exit boxes.
MetaTable buildMetaTable(uvec3 resolution, std::span<const Leaf> leaves);

} // namespace metamarch
