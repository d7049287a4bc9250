// SPDX-License-Identifier: MIT
// Tests every triangle of the scene.
//
// It needs no structure. It shows how much the other traversals save, and it cannot miss a triangle.
//
// Why it ends: the loop counts to the number of triangles.
//
// Cost: one triangle record and one test for each triangle of the scene; no memory per ray.
//
// Ties: of hits with the same t, the one with the smaller triangle id wins (isCloser), so the order of tests
// does not matter.

#extension GL_EXT_control_flow_attributes : require
#include "lib/scene.glsl"

// Number of triangles per turn. Mesa's llvmpipe (22.3.6) ends the loops of an invocation after 65,535 turns
// in total, without an error; these turns are enough for 2^19 triangles.
const uint kBlock = 8u;

// Finds the closest hit or, if anyHit (a compile-time constant), any hit. `trace` comes from startTrace.
void traverse(const Ray ray, const bool anyHit, inout Trace trace) {
    if (ray.tMax < ray.tMin) {
        finish(trace);
        return;
    }

    trace.expectedTests = lattice.triangleCount;

    // Invariant: the triangles before `first` have been tested.
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
