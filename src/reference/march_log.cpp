// SPDX-License-Identifier: MIT
#include "metamarch/reference/march_log.h"

#include "metamarch/reference/meta_table_march.h"

namespace metamarch {

MarchLog logMarch(const AccelerationStructure& scene, const Ray& ray, const HitQuery query) {
    MarchLog log;
    float tNear = ray.tNear;
    std::uint32_t tests = 0;
    log.result = marchMetaTable<Invariants::checked>(scene, ray, query, [&](const MarchTurn& turn) {
        const Hit& best = turn.trace.hit;
        const CellBox exitBox = boxOf(turn.leaf);
        const float tFar = leaveBox(ray, exitBox.lo, exitBox.hi, turn.cell).t;
        log.steps.push_back({turn.cell,
                             turn.leafId,
                             exitBox,
                             turn.leaf.triangleCount,
                             turn.trace.tests - tests,
                             ray.shift + tNear,
                             ray.shift + tFar,
                             {ray.shift + best.t, best.triangleId},
                             false});
        tNear = tFar;
        tests = turn.trace.tests;
    });
    if (!log.steps.empty()) {
        log.steps.back().isFinal = log.result.hit.triangleId != kNoTriangle;
    }
    return log;
}

} // namespace metamarch
