// SPDX-License-Identifier: MIT
#include "metamarch/reference/walk_log.h"

#include "metamarch/reference/kd_stack_walk.h"

#include <unordered_map>

namespace metamarch {

WalkLog logWalk(const AccelerationStructure& scene, const Ray& ray, const HitQuery query) {
    WalkLog log;
    std::unordered_map<std::uint32_t, std::size_t>
        parents; // index of the visit, for each child of a visited node
    log.result = walkKdStack(scene, ray, query, [&](const WalkTurn& turn) {
        const std::size_t index = log.visits.size();
        const auto found = parents.find(turn.nodeId);
        const std::size_t parent = found == parents.end() ? WalkVisit::kNone : found->second;
        WalkVisit visit{turn.nodeId,
                        parent == WalkVisit::kNone ? 0u : log.visits[parent].depth + 1,
                        parent,
                        isLeaf(turn.node),
                        isLeaf(turn.node) ? scene.tree.leaves[leafOf(turn.node)].triangleCount : 0u,
                        ray.shift + turn.tNear,
                        {},
                        turn.trace.tests};
        for (const PendingNode& pending : turn.stack) {
            visit.stack.push_back(pending.nodeId);
        }
        if (!visit.isLeaf) {
            parents[turn.nodeId + 1] = index;
            parents[childAbove(turn.node)] = index;
        }
        log.visits.push_back(std::move(visit));
    });
    return log;
}

} // namespace metamarch
