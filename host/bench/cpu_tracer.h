// Rays through the judges, many at a time.
#pragma once
#include "reference/twins.h"
#include "shared/ray_query.h"

#include <span>
#include <vector>

namespace metamarch::bench {

// What every traversal is compared with: the CPU's stack traversal, on all processors. One result per ray;
// with `slots` also each hit's record in structure.triangles.
std::vector<RayResult> judge(const AccelerationStructure& structure, std::span<const RayQuery> rays,
                             HitQuery query, std::vector<std::uint32_t>* slots = nullptr);

struct CpuRun {
    std::vector<RayResult> results; // one per ray
    double seconds;                 // wall time
};

// Ray set-up and traversal, one ray after the other in one thread, as the kernel `rays` does it.
CpuRun traceInOneThread(const StructureSet& structures, std::span<const RayQuery> rays, HitQuery query,
                        const Twin& twin);

} // namespace metamarch::bench
