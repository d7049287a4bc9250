#include "reference/march_log.h"

#include "reference/meta_table_march.h"

namespace metamarch {

MarchLog logMarch(const AccelerationStructure& scene, const Ray& ray, const HitQuery query) {
    MarchLog log;
    float tNear = ray.tNear;
    log.result = marchMetaTable<Invariants::checked>(scene, ray, query, [&](const MarchTurn& turn) {
        const Hit& best = turn.trace.hit;
        log.steps.push_back({turn.cell,
                             turn.leafId,
                             {turn.lo, turn.hi},
                             turn.leaf.triangleCount,
                             ray.shift + tNear,
                             ray.shift + turn.exit.t,
                             {ray.shift + best.t, best.triangleId},
                             false});
        tNear = turn.exit.t;
    });
    if (!log.steps.empty()) {
        log.steps.back().isFinal = log.result.hit.triangleId != kNoTriangle;
    }
    return log;
}

} // namespace metamarch
