// SPDX-License-Identifier: MIT
// Records the march of one ray through the meta table, step by step.
#pragma once
#include "metamarch/accel/cell_box.h"
#include "metamarch/reference/trace.h"

#include <cstdint>
#include <vector>

namespace metamarch {

// Every t counts from the origin that the caller gave for the ray, so it contains ray.shift. Its unit is the
// length of dir.
struct MarchStep {
    ivec3 cell; // the cell that was looked up
    std::uint32_t leafId;
    CellBox exitBox;
    std::uint32_t triangleCount; // number of triangles of the leaf
    std::uint32_t tests;         // number of them that were tested in this step: the ray met their boxes
    float tNear;                 // at which the step begins
    float tFar;                  // at which the ray leaves the exit box
    Hit best;                    // after the step; without a hit, t is the end of the ray
    bool isFinal;                // `best` is the ray's hit, and the march ends
};

struct MarchLog {
    std::vector<MarchStep> steps; // none if the ray misses the lattice
    TraceResult result;           // of traceMetaTable; its t counts from ray.origin
};

// Throws what traceMetaTable throws.
MarchLog logMarch(const AccelerationStructure& scene, const Ray& ray, HitQuery query = HitQuery::closest);

} // namespace metamarch
