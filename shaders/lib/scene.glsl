// What every traversal reads of the scene: lattice, materials and triangle records. The structures that only
// some of them walk are in the other files of this folder; nothing outside it knows how memory is reached.
#ifndef METAMARCH_LIB_SCENE_GLSL
#define METAMARCH_LIB_SCENE_GLSL
#include "shared/scene_layout.h"
#include "shared/triangle.h"

layout(constant_id = kSpecTriangleChunks) const uint triangleChunks = 1u;
layout(constant_id = kSpecTrianglesPerChunk) const uint trianglesPerChunk = 0xffffffffu;

layout(std140, binding = kBindLattice) uniform LatticeBuffer { Lattice lattice; };
layout(std430, binding = kBindMaterialOfTriangle) readonly buffer MaterialOfTriangleBuffer {
    uint materialOfTriangle[];
};
layout(std430, binding = kBindMaterials) readonly buffer MaterialBuffer { ShadingMaterial materials[]; };
layout(std430, binding = kBindTriangles) readonly buffer TriangleBuffer0 { TriangleRecord triangles0[]; };
layout(std430, binding = kBindTriangles + 1u) readonly buffer TriangleBuffer1 {
    TriangleRecord triangles1[];
};
layout(std430, binding = kBindTriangles + 2u) readonly buffer TriangleBuffer2 {
    TriangleRecord triangles2[];
};
layout(std430, binding = kBindTriangles + 3u) readonly buffer TriangleBuffer3 {
    TriangleRecord triangles3[];
};
layout(std430, binding = kBindTriangles + 4u) readonly buffer TriangleBuffer4 {
    TriangleRecord triangles4[];
};
layout(std430, binding = kBindTriangles + 5u) readonly buffer TriangleBuffer5 {
    TriangleRecord triangles5[];
};
layout(std430, binding = kBindTriangles + 6u) readonly buffer TriangleBuffer6 {
    TriangleRecord triangles6[];
};
layout(std430, binding = kBindTriangles + 7u) readonly buffer TriangleBuffer7 {
    TriangleRecord triangles7[];
};

// The chunk is chosen by a branch: indexing an array of buffers by a value that differs between invocations
// needs a feature that lavapipe 22.3 lacks.
TriangleRecord loadTriangle(const uint slot) {
    if (triangleChunks == 1u) {
        return triangles0[slot];
    }
    const uint chunk = slot / trianglesPerChunk;
    const uint i = slot - chunk * trianglesPerChunk;
    switch (chunk) {
    case 0u:
        return triangles0[i];
    case 1u:
        return triangles1[i];
    case 2u:
        return triangles2[i];
    case 3u:
        return triangles3[i];
    case 4u:
        return triangles4[i];
    case 5u:
        return triangles5[i];
    case 6u:
        return triangles6[i];
    default:
        return triangles7[i];
    }
}

// What a traversal found and what it took.
struct Trace {
    Hit hit;
    uint slot;  // the hit triangle's record
    uint steps; // look-ups of the march, cells, or inner nodes and leaves visited
    uint tests; // triangle tests
    uint due;   // tests that the leaves visited ask for
    bool finished;
};

Trace startTrace(const Ray ray) { return Trace(Hit(ray.tMax, kNoTriangle), 0u, 0u, 0u, 0u, false); }

// Every traversal ends with this. One that does not come here, or comes with tests left out, was ended by the
// driver: Mesa's llvmpipe (22.3.6) leaves all loops after 65,535 turns together, without a word.
void finish(inout Trace trace) { trace.finished = trace.tests == trace.due; }

// Tests the triangle in `slot` and keeps it where it is closer than what `trace` has.
void testTriangle(const Ray ray, const uint slot, inout Trace trace) {
    ++trace.tests;
    const TriangleRecord triangle = loadTriangle(slot);
    const float t = intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2);
    if (t != kNoHit && t <= trace.hit.t) {
        const uint triangleId = triangle.triangleId;
        if (isCloser(t, triangleId, trace.hit)) {
            trace.hit = Hit(t, triangleId);
            trace.slot = slot;
        }
    }
}

void testTriangles(const Ray ray, const uint first, const uint count, inout Trace trace) {
    trace.due += count;
    for (uint i = 0u; i < count; ++i) {
        testTriangle(ray, first + i, trace);
    }
}

bool isDone(const Trace trace, const bool anyHit) { return anyHit && trace.hit.triangleId != kNoTriangle; }
#endif
