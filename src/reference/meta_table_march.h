// SPDX-License-Identifier: MIT
// The loop of the march through the meta table, with an observer.
#pragma once
#include "metamarch/reference/require.h"
#include "metamarch/reference/triangle_records.h"
#include "metamarch/shared/march.h"
#include "metamarch/shared/reference_box.h"

#include <algorithm>
#include <bit>

namespace metamarch {

// One turn of the loop: the cell's leaf has been tested, and the ray has yet to leave its exit box.
struct MarchTurn {
    ivec3 cell;
    std::uint32_t leafId;
    const Leaf& leaf;
    const TraceResult& trace; // with this turn's tests
};

// Tests the triangles of a leaf whose boxes the ray meets within `inExit`, the part of the ray in the exit
// box. `record` is the first entry of the leaf's record.
inline void testLeaf(const AccelerationStructure& scene, const Ray& ray, const std::uint32_t record,
                     const vec2 inExit, const HitQuery query, TraceResult& trace) {
    const std::uint32_t* const words = scene.table.leafRecords.data();
    const auto loadFour = [&](const std::size_t i) {
        return uvec4(words[4 * i], words[4 * i + 1], words[4 * i + 2], words[4 * i + 3]);
    };
    const std::uint32_t triangleCount = loadFour(record).w;
    if (triangleCount == 0) {
        return;
    }
    const uvec3 shift = nearPlaneShift(ray);
    const uvec4 stored = loadFour(frameEntry(record));
    const FrameCrossing frame = crossFrame(ray, {stored.x, stored.y, stored.z, stored.w});
    const vec2 span =
        crossReferenceBox(frame, shift, kWholeFrame, {inExit.x, smaller(inExit.y, trace.hit.t)});
    if (span.x > span.y) {
        return;
    }
    const std::uint32_t* const indices = &words[4 * std::size_t{stored.w}];
    for (std::uint32_t round = 0; round < triangleCount && !isDone(trace, query); round += kMostCandidates) {
        const std::uint32_t end = std::min(triangleCount, round + kMostCandidates);
        std::uint32_t candidates = 0;
        for (std::uint32_t met = round; met < end; met += kBoxesPerGroup) {
            const uvec4 boxes = loadFour(firstBoxes(record) + met / kBoxesPerGroup);
            candidates |= meetBoxes(frame, shift, boxes, span) << (met - round);
        }
        for (; candidates != 0 && !isDone(trace, query); candidates &= candidates - 1) {
            const std::uint32_t reference = round + static_cast<std::uint32_t>(std::countr_zero(candidates));
            testTriangle(scene.table.triangles, ray, indices[reference], trace);
        }
    }
}

// Calls `observe` with each MarchTurn. An observer that does nothing costs nothing.
template <Invariants invariants, class Observer>
[[gnu::always_inline]] inline TraceResult marchMetaTable(const AccelerationStructure& scene, const Ray& ray,
                                                         const HitQuery query, Observer&& observe) {
    TraceResult trace = startTrace(ray);
    if (ray.tMax < ray.tMin) {
        return trace;
    }
    const uvec3 resolution = scene.lattice.resolution;
    const std::uint32_t mostSteps = resolution.x + resolution.y + resolution.z;
    const bvec3 upward = greaterThan(ray.invStride, vec3(0.0f));
    ivec3 cell = cellAt(ray, ray.tNear, ivec3(0), ivec3(resolution));
    float tNear = ray.tNear;
    while (true) {
        require<invariants>(isInLattice(cell, resolution), "the march left the lattice");
        require<invariants>(trace.steps < mostSteps, "the march did not end");
        ++trace.steps;
        const std::uint32_t leafId = scene.table.leafAt(cell);
        const Leaf& leaf = scene.table.leaves[leafId];
        const ivec3 lo = unpackCell(leaf.lo);
        const ivec3 hi = unpackCell(leaf.hi);
        require<invariants>(cell == clamp(cell, lo, hi - 1),
                            "the table names a leaf that does not hold the cell");
        const BoxExit next = leaveBox(ray, lo, hi, cell);
        require<invariants>(movedOn(cell, next.cell, upward), "the march did not move on");
        testLeaf(scene, ray, scene.table.recordAt(cell), {tNear, next.t}, query, trace);
        observe(MarchTurn{cell, leafId, leaf, trace});
        if (isDone(trace, query)) {
            return trace;
        }
        if (trace.hit.t <= next.t || !isInLattice(next.cell, resolution)) {
            return trace;
        }
        cell = next.cell;
        tNear = next.t;
    }
}

} // namespace metamarch
