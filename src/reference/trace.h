// SPDX-License-Identifier: MIT
// The judges: ways to find a ray's hit on the CPU. All of them read the same records with the same triangle
// test and must name the same triangle at the same t, to the bit.
//
// All are [[gnu::flatten]]: the shared functions take a ray by value, and a call would copy it at each step,
// which no compiler of shaders does.
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
    std::uint32_t recordIndex = 0; // record of the hit triangle, where the judge reads records in leaf order
    std::uint32_t steps = 0;       // look-ups of the march, or nodes visited
    std::uint32_t tests = 0;       // triangle tests
};

// Tests every one of `triangles` (makeTriangleRecords of every non-degenerate triangle). Judges the other
// judges: it knows neither tree nor table.
TraceResult traceBruteForce(std::span<const TriangleRecord> triangles, const Ray& ray, HitQuery query);

// The classic walk of the kd-tree with a stack: the paper's figures 3 and 4, with the closest hit made safe
// against triangles that reach past their leaf. Visits are inner nodes and leaves.
TraceResult traceKdStack(const AccelerationStructure& scene, const Ray& ray, HitQuery query);

// The march through the meta table, step for step what shaders/traversal/meta_table.glsl does. Throws
// std::logic_error where an invariant of the march is checked and broken.
template <Invariants invariants = Invariants::checked>
TraceResult traceMetaTable(const AccelerationStructure& scene, const Ray& ray, HitQuery query);

} // namespace metamarch
