// SPDX-License-Identifier: MIT
// Tests every triangle of the scene.
//
// No structure at all: the measure of what the others save, and the one that cannot lose a triangle.
//
// Why it ends: the loop counts to the number of triangles.
//
// What it costs: one triangle record and one test for each triangle of the scene; no memory per ray.
//
// Ties: of equal t the smaller triangle id stays (isCloser), so the order of tests does not matter.

#extension GL_EXT_control_flow_attributes : require
#include "lib/scene.glsl"

// Triangles of one turn. Mesa's llvmpipe (22.3.6) ends an invocation's loops after 65,535 turns, all loops
// together, without a word: so many turns reach 2^19 triangles.
const uint kBlock = 8u;

// Finds the closest hit, or any hit when anyHit (folded at compile time); `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }

    trace.expectedTests = lattice.triangleCount;

    // Holds here: the triangles before `first` have been tested.
    for (uint first = 0u; first < lattice.triangleCount; first += kBlock) {
        [[unroll]] for (uint i = 0u; i < kBlock; ++i) {
            if (first + i < lattice.triangleCount && !isDone(trace, anyHit)) {
                testTriangle(ray, first + i, trace);
            }
        }
        if (isDone(trace, anyHit)) {
            trace.expectedTests = trace.tests;
            break;
        }
    }
    finish(trace);
}
