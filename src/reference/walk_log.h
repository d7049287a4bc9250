// SPDX-License-Identifier: MIT
// Records how the stack traversal takes one ray through the kd-tree, visit by visit.
#pragma once
#include "metamarch/reference/trace.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace metamarch {

// Every t counts as those of MarchStep.
struct WalkVisit {
    static constexpr std::size_t kNone = ~std::size_t{0};

    std::uint32_t nodeId;
    std::uint32_t depth; // of the node in the tree; the root has 0
    std::size_t parent;  // index of its parent's visit; kNone for the root
    bool isLeaf;
    std::uint32_t triangleCount;      // of a leaf
    float tNear;                      // where the part of the ray begins that the node is visited for
    std::vector<std::uint32_t> stack; // node ids after the visit; the next to be visited is the last
    std::uint32_t tests;              // number of triangle tests, this visit's included
};

struct WalkLog {
    std::vector<WalkVisit> visits; // none if the ray misses the lattice
    TraceResult result;            // of traceKdStack
};

WalkLog logWalk(const AccelerationStructure& scene, const Ray& ray, HitQuery query = HitQuery::closest);

} // namespace metamarch
