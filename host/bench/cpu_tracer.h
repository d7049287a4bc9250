// SPDX-License-Identifier: MIT
// Traces many rays at a time on the CPU.
#pragma once
#include "metamarch/reference/twins.h"
#include "metamarch/shared/ray_query.h"

#include <span>
#include <vector>

namespace metamarch::bench {

// The results that every traversal is compared with.
struct Judgement {
    std::vector<RayResult> results;           // one per ray
    std::vector<std::uint32_t> recordIndices; // of hits in structure.triangles; kNoRecord for a miss
};

// Traces the rays with the CPU's stack traversal, on all processors.
Judgement judge(const AccelerationStructure& structure, std::span<const RayQuery> rays, HitQuery query);

struct TimedRun {
    std::vector<RayResult> results; // one per ray
    double seconds;                 // wall time
};

// Sets up and traces one ray after the other in one thread, with the same work per ray as the kernel `rays`.
TimedRun traceInOneThread(const StructureSet& structures, std::span<const RayQuery> rays, HitQuery query,
                          TwinFunction& twin);

// Does the same for rays whose hit record is known, with the same work per ray as the kernel `floor`.
TimedRun traceFloorInOneThread(const AccelerationStructure& structure, std::span<const RayQuery> rays,
                               std::span<const std::uint32_t> recordIndices);

} // namespace metamarch::bench
