// SPDX-License-Identifier: MIT
#include "metamarch/accel/kd_links.h"

#include "metamarch/shared/kd_rope.h"

#include <array>

namespace metamarch {
namespace {

using Ropes = std::array<std::uint32_t, kRopesPerLeaf>;

void linkBelow(const KdTree& tree, const std::uint32_t nodeId, const std::uint32_t parent, const uvec3 lo,
               const uvec3 hi, std::vector<KdParent>& links) {
    links[nodeId] = {packCell(lo), packCell(hi), parent, 0};
    const KdNode& node = tree.nodes[nodeId];
    if (isLeaf(node)) {
        return;
    }
    const int axis = static_cast<int>(splitAxis(node));
    uvec3 middleHi = hi;
    uvec3 middleLo = lo;
    middleHi[axis] = splitPlane(node);
    middleLo[axis] = splitPlane(node);
    linkBelow(tree, nodeId + 1, nodeId, lo, middleHi, links);
    linkBelow(tree, childAbove(node), nodeId, middleLo, hi, links);
}

// Moves the rope at a face of the box [lo, hi) down the tree while a single child holds all that lies behind
// the face.
std::uint32_t letDown(const KdTree& tree, std::uint32_t rope, const unsigned faceAxis, const bool above,
                      const ivec3 lo, const ivec3 hi) {
    while (rope != kNoRope && !isLeaf(tree.nodes[rope])) {
        const KdNode& node = tree.nodes[rope];
        const std::uint32_t axis = splitAxis(node);
        const int plane = static_cast<int>(splitPlane(node));
        if (axis == faceAxis) {
            rope = above ? rope + 1 : childAbove(node);
        } else if (plane >= hi[static_cast<int>(axis)]) {
            rope = rope + 1;
        } else if (plane <= lo[static_cast<int>(axis)]) {
            rope = childAbove(node);
        } else {
            break;
        }
    }
    return rope;
}

void tieBelow(const KdTree& tree, const std::uint32_t nodeId, const Ropes& given,
              std::vector<std::uint32_t>& ropes) {
    const KdNode& node = tree.nodes[nodeId];
    if (!isLeaf(node)) {
        const std::uint32_t axis = splitAxis(node);
        Ropes below = given;
        Ropes above = given;
        below[ropeIndex(0, axis, true)] = childAbove(node);
        above[ropeIndex(0, axis, false)] = nodeId + 1;
        tieBelow(tree, nodeId + 1, below, ropes);
        tieBelow(tree, childAbove(node), above, ropes);
        return;
    }
    const Leaf& leaf = tree.leaves[leafOf(node)];
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const bool above : {false, true}) {
            ropes[ropeIndex(leafOf(node), axis, above)] =
                letDown(tree, given[ropeIndex(0, axis, above)], axis, above, unpackCell(leaf.lo),
                        unpackCell(leaf.hi));
        }
    }
}

} // namespace

// The recursion is at most kMaxTreeDepth deep.
std::vector<KdParent> linkParents(const Lattice& lattice, const KdTree& tree) {
    std::vector<KdParent> links(tree.nodes.size());
    linkBelow(tree, 0, 0, uvec3(0), lattice.resolution, links);
    return links;
}

std::vector<std::uint32_t> tieRopes(const KdTree& tree) {
    std::vector<std::uint32_t> ropes(tree.leaves.size() * kRopesPerLeaf);
    Ropes none;
    none.fill(kNoRope);
    tieBelow(tree, 0, none, ropes);
    return ropes;
}

} // namespace metamarch
