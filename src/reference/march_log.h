// SPDX-License-Identifier: MIT
// The march of one ray through the meta table, step by step.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/reference/trace.h"

#include <cstdint>
#include <vector>

namespace metamarch {

// Every t is counted from the origin that the ray was asked from, in lengths of its dir: ray.shift is in it.
struct MarchStep {
    ivec3 cell; // that was looked up
    std::uint32_t leafId;
    CellBox exitBox;
    std::uint32_t triangleCount; // of the leaf, each tested in this step
    float tNear;                 // of the crossing: where the march stood,
    float tFar;                  // and where it leaves the exit box
    Hit best;                    // after the step; without a hit, t is where the ray ends
    bool isFinal;                // best is the ray's hit: the march ends with it
};

struct MarchLog {
    std::vector<MarchStep> steps; // none where the ray misses the lattice
    TraceResult result;           // of traceMetaTable, its t counted from ray.origin
};

// Throws as traceMetaTable does.
MarchLog logMarch(const AccelerationStructure& scene, const Ray& ray, HitQuery query = HitQuery::closest);

} // namespace metamarch
