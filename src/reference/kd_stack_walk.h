// SPDX-License-Identifier: MIT
// The loop of the stack traversal, once for the judge and for the log.
#pragma once
#include "metamarch/reference/triangle_records.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace metamarch {

struct PendingNode {
    std::uint32_t nodeId;
    float tNear;
    float tFar;
};

// A visit, after its tests, or after its far child was put on the stack.
struct WalkTurn {
    std::uint32_t nodeId;
    const KdNode& node;
    std::span<const PendingNode> stack; // the nearest is the last
    float tNear;                        // of the part of the ray that the node was visited for
    const TraceResult& trace;
};

// Calls `observe` with each WalkTurn. An observer that does nothing costs nothing.
template <class Observer>
[[gnu::always_inline]] inline TraceResult walkKdStack(const AccelerationStructure& scene, const Ray& ray,
                                                      const HitQuery query, Observer&& observe) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    // The builder keeps every path within kMaxTreeDepth edges, and a path leaves one pending child per edge.
    std::array<PendingNode, kMaxTreeDepth> stack;
    std::size_t stackSize = 0;
    std::uint32_t nodeId = 0;
    float tNear = ray.tNear;
    float tFar = ray.tFar;

    // Invariant: every triangle that the ray meets before tNear has been tested; the stack holds the nodes
    // behind tFar, the nearest on top. Each turn goes one node down or pops one from the stack, so the loop
    // ends.
    while (true) {
        ++trace.steps;
        const std::uint32_t visited = nodeId;
        const float tEnter = tNear;
        const KdNode node = scene.tree.nodes[nodeId];
        if (!isLeaf(node)) {
            const int axis = static_cast<int>(splitAxis(node));
            const float offset = static_cast<float>(splitPlane(node)) - ray.start[axis];
            const float tSplit = offset * ray.invStride[axis];
            // The near child contains the origin; if the origin is on the plane, it is the child that the ray
            // comes from.
            const bool upward = ray.invStride[axis] > 0.0f;
            const bool belowIsNear = offset > 0.0f || (offset == 0.0f && upward);
            const std::uint32_t below = nodeId + 1;
            const std::uint32_t above = childAbove(node);
            const std::uint32_t near = belowIsNear ? below : above;
            const std::uint32_t far = belowIsNear ? above : below;
            if (tSplit >= tFar || tSplit < 0.0f) {
                nodeId = near;
            } else if (tSplit <= tNear) {
                nodeId = far;
            } else {
                stack[stackSize++] = {far, tSplit, tFar};
                nodeId = near;
                tFar = tSplit;
            }
            observe(WalkTurn{visited, node, std::span(stack).first(stackSize), tEnter, trace});
            continue;
        }

        const Leaf& leaf = scene.tree.leaves[leafOf(node)];
        testTriangles(scene.triangles, ray, leaf.firstTriangle, leaf.triangleCount, trace);
        observe(WalkTurn{visited, node, std::span(stack).first(stackSize), tEnter, trace});
        // A triangle may extend beyond its leaf, so only a hit inside the leaf is known to be the closest.
        if (isDone(trace, query) || trace.hit.t <= tFar || stackSize == 0) {
            return trace;
        }
        --stackSize;
        nodeId = stack[stackSize].nodeId;
        tNear = stack[stackSize].tNear;
        tFar = stack[stackSize].tFar;
    }
}

} // namespace metamarch
