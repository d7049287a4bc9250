// SPDX-License-Identifier: MIT
// Rays through the judges, many at a time.
#pragma once
#include "metamarch/reference/twins.h"
#include "metamarch/shared/ray_query.h"

#include <span>
#include <vector>

namespace metamarch::bench {

// What every traversal is compared with.
struct Judgement {
    std::vector<RayResult> results;           // one per ray
    std::vector<std::uint32_t> recordIndices; // of hits in structure.triangles; kNoRecord for a miss
};

// The CPU's stack traversal, on all processors.
Judgement judge(const AccelerationStructure& structure, std::span<const RayQuery> rays, HitQuery query);

struct TimedRun {
    std::vector<RayResult> results; // one per ray
    double seconds;                 // wall time
};

// Ray set-up and traversal, one ray after the other in one thread, as the kernel `rays` does it.
TimedRun traceInOneThread(const StructureSet& structures, std::span<const RayQuery> rays, HitQuery query,
                          TwinFunction& twin);

// The same when the record that each ray hits is known, as the kernel `floor` does it.
TimedRun traceFloorInOneThread(const AccelerationStructure& structure, std::span<const RayQuery> rays,
                               std::span<const std::uint32_t> recordIndices);

} // namespace metamarch::bench
