// SPDX-License-Identifier: MIT
// The judges: ways to find a ray's hit on the CPU. All of them use the same records and the same triangle
// test, and must find the same triangle at the same t, bit by bit.
//
// All are [[gnu::flatten]]: the shared functions take a ray by value, and a call would copy it at each step.
// No compiler of shaders does that.
#pragma once
#include "metamarch/accel/acceleration_structure.h"
#include "metamarch/reference/require.h"
#include "metamarch/shared/ray.h"
#include "metamarch/shared/triangle.h"

#include <cstdint>
#include <span>

namespace metamarch {

enum class HitQuery { closest, any };

struct TraceResult {
    Hit hit;
    std::uint32_t recordIndex =
        0;                   // index of the hit triangle's record, if the judge reads records in leaf order
    std::uint32_t steps = 0; // number of steps or node visits
    std::uint32_t tests = 0; // number of triangle tests
};

// Tests all of `triangles` (makeTriangleRecords of every non-degenerate triangle). It uses neither tree nor
// table, so it judges the other judges.
TraceResult traceBruteForce(std::span<const TriangleRecord> triangles, const Ray& ray, HitQuery query);

// Walks the kd-tree with a stack: the paper's figures 3 and 4, but correct for triangles that extend beyond
// their leaf. Visits are inner nodes and leaves.
TraceResult traceKdStack(const AccelerationStructure& scene, const Ray& ray, HitQuery query);

// Marches through the meta table with the same steps as shaders/traversal/meta_table.glsl. Throws
// std::logic_error if an invariant is checked and does not hold.
template <Invariants invariants = Invariants::checked>
TraceResult traceMetaTable(const AccelerationStructure& scene, const Ray& ray, HitQuery query);

} // namespace metamarch
