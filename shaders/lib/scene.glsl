// SPDX-License-Identifier: MIT
// The part of the scene that every traversal reads: lattice, materials and triangle records. The other files
// of this folder have the structures that only some traversals walk. Only this folder accesses the scene's
// memory.
#ifndef METAMARCH_LIB_SCENE_GLSL
#define METAMARCH_LIB_SCENE_GLSL
#include "lib/triangles.glsl"
#include "shared/triangle.h"

layout(std140, binding = kBindLattice) uniform LatticeBuffer { Lattice lattice; };
layout(std430, binding = kBindMaterialOfTriangle) readonly buffer MaterialOfTriangleBuffer {
    uint materialOfTriangle[];
};
layout(std430, binding = kBindMaterials) readonly buffer MaterialBuffer { ShadingMaterial materials[]; };

// The result of a traversal, and its counts.
struct Trace {
    Hit hit;
    uint recordIndex;   // index of the hit triangle's record
    uint steps;         // number of steps (cells looked up), or of inner nodes and leaves visited
    uint tests;         // number of triangle tests
    uint expectedTests; // number of tests that the visited leaves need
    bool finished;
};

Trace startTrace(const Ray ray) { return Trace(Hit(ray.tMax, kNoTriangle), 0u, 0u, 0u, 0u, false); }

// Every traversal calls this at its end. If it does not, or if tests are missing, the driver has ended it
// early: Mesa's llvmpipe (22.3.6) leaves all loops of an invocation after 65,535 turns in total, without an
// error.
void finish(inout Trace trace) { trace.finished = trace.tests == trace.expectedTests; }

// The same behind a loop that has ended by its condition. There the compiler takes the condition for false,
// although the driver may have ended the loop. So the loop keeps in a number what is left to do.
void finishUnless(const uint left, inout Trace trace) {
    trace.expectedTests += left;
    finish(trace);
}

// Stores the hit of the triangle record in `trace` if it is closer than the hit there.
void keepCloser(const Ray ray, const uint recordIndex, inout Trace trace) {
    const TriangleRecord triangle = loadTriangle(recordIndex);
    const float t = intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2);
    if (t != kNoHit && t <= trace.hit.t) {
        const uint triangleId = triangle.triangleId;
        if (isCloser(t, triangleId, trace.hit)) {
            trace.hit = Hit(t, triangleId);
            trace.recordIndex = recordIndex;
        }
    }
}

void testTriangle(const Ray ray, const uint recordIndex, inout Trace trace) {
    ++trace.tests;
    keepCloser(ray, recordIndex, trace);
}

void testTriangles(const Ray ray, const uint first, const uint count, inout Trace trace) {
    uint recordIndex = first;
    const uint end = first + count;
    if (recordIndex < end) {
        // llvmpipe leaves a loop only at its end; with the condition at the top it would make an extra turn.
        do {
            keepCloser(ray, recordIndex, trace);
            ++recordIndex;
        } while (recordIndex < end);
    }
    trace.tests += recordIndex - first;
    trace.expectedTests += count;
}

bool isDone(const Trace trace, const bool anyHit) { return anyHit && trace.hit.triangleId != kNoTriangle; }
#endif
