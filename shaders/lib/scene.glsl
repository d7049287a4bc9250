// SPDX-License-Identifier: MIT
// What every traversal reads of the scene: lattice, materials and triangle records. The structures that only
// some of them walk are in the other files of this folder; nothing outside it knows how memory is reached.
#ifndef METAMARCH_LIB_SCENE_GLSL
#define METAMARCH_LIB_SCENE_GLSL
#include "lib/triangles.glsl"
#include "shared/triangle.h"

layout(std140, binding = kBindLattice) uniform LatticeBuffer { Lattice lattice; };
layout(std430, binding = kBindMaterialOfTriangle) readonly buffer MaterialOfTriangleBuffer {
    uint materialOfTriangle[];
};
layout(std430, binding = kBindMaterials) readonly buffer MaterialBuffer { ShadingMaterial materials[]; };

// What a traversal found and what it took.
struct Trace {
    Hit hit;
    uint recordIndex;   // the hit triangle's record
    uint steps;         // look-ups of the march, cells, or inner nodes and leaves visited
    uint tests;         // triangle tests
    uint expectedTests; // tests that the leaves visited ask for
    bool finished;
};

Trace startTrace(const Ray ray) { return Trace(Hit(ray.tMax, kNoTriangle), 0u, 0u, 0u, 0u, false); }

// Every traversal ends with this. One that does not come here, or comes with tests left out, was ended by the
// driver: Mesa's llvmpipe (22.3.6) leaves all loops after 65,535 turns together, without a word.
void finish(inout Trace trace) { trace.finished = trace.tests == trace.expectedTests; }

// Keeps the triangle of record `recordIndex` where the ray meets it closer than what `trace` has.
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
        // llvmpipe leaves a loop at its end only: with the question at the top it would make one turn too
        // many.
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
