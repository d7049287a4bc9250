// The scene's buffers: the only file that knows how memory is reached.
#ifndef METAMARCH_LIB_SCENE_GLSL
#define METAMARCH_LIB_SCENE_GLSL
#include "shared/scene_layout.h"
#include "shared/triangle.h"

layout(constant_id = kSpecTriangleChunks) const uint triangleChunks = 1u;
layout(constant_id = kSpecTrianglesPerChunk) const uint trianglesPerChunk = 0xffffffffu;

layout(std430, binding = kBindLattice) readonly buffer LatticeBuffer { Lattice lattice; };
layout(std430, binding = kBindLeaves) readonly buffer LeafBuffer { Leaf leaves[]; };
layout(std430, binding = kBindTable) readonly buffer TableBuffer { uint leafOfCell[]; };
layout(std430, binding = kBindMaterialOfTriangle) readonly buffer MaterialOfTriangleBuffer {
    uint materialOfTriangle[];
};
layout(std430, binding = kBindMaterials) readonly buffer MaterialBuffer { ShadingMaterial materials[]; };
layout(std430, binding = kBindTriangles) readonly buffer TriangleBuffer0 { uint triangleWords0[]; };
layout(std430, binding = kBindTriangles + 1u) readonly buffer TriangleBuffer1 { uint triangleWords1[]; };
layout(std430, binding = kBindTriangles + 2u) readonly buffer TriangleBuffer2 { uint triangleWords2[]; };
layout(std430, binding = kBindTriangles + 3u) readonly buffer TriangleBuffer3 { uint triangleWords3[]; };
layout(std430, binding = kBindTriangles + 4u) readonly buffer TriangleBuffer4 { uint triangleWords4[]; };
layout(std430, binding = kBindTriangles + 5u) readonly buffer TriangleBuffer5 { uint triangleWords5[]; };
layout(std430, binding = kBindTriangles + 6u) readonly buffer TriangleBuffer6 { uint triangleWords6[]; };
layout(std430, binding = kBindTriangles + 7u) readonly buffer TriangleBuffer7 { uint triangleWords7[]; };

// Reads one coordinate or the id of a triangle record. The chunk is chosen by a branch: indexing an array of
// buffers by a value that differs between invocations needs a feature that lavapipe 22.3 lacks.
uint triangleWord(const uint slot, const uint word) {
    if (triangleChunks == 1u) {
        return triangleWords0[slot * kTriangleWords + word];
    }
    const uint chunk = slot / trianglesPerChunk;
    const uint i = (slot - chunk * trianglesPerChunk) * kTriangleWords + word;
    switch (chunk) {
    case 0u:
        return triangleWords0[i];
    case 1u:
        return triangleWords1[i];
    case 2u:
        return triangleWords2[i];
    case 3u:
        return triangleWords3[i];
    case 4u:
        return triangleWords4[i];
    case 5u:
        return triangleWords5[i];
    case 6u:
        return triangleWords6[i];
    default:
        return triangleWords7[i];
    }
}

// Corner 0, 1 or 2 of the triangle in `slot`, its coordinates in the order of `axes`.
vec3 triangleCorner(const uint slot, const uint corner, const uvec3 axes) {
    return vec3(uintBitsToFloat(triangleWord(slot, 3u * corner + axes.x)),
                uintBitsToFloat(triangleWord(slot, 3u * corner + axes.y)),
                uintBitsToFloat(triangleWord(slot, 3u * corner + axes.z)));
}

uint triangleIdOf(const uint slot) { return triangleWord(slot, kTriangleIdWord); }

// What a traversal found and what it took.
struct Trace {
    Hit hit;
    uint slot;  // the hit triangle's record
    uint steps; // look-ups of the march, or nodes visited
    uint tests; // triangle tests
};

Trace startTrace(const Ray ray) { return Trace(Hit(ray.tMax, kNoTriangle), 0u, 0u, 0u); }

// Tests the triangle in `slot` and keeps it where it is closer than what `trace` has.
void testTriangle(const Ray ray, const uint slot, inout Trace trace) {
    ++trace.tests;
    const float t = intersectTriangle(ray, triangleCorner(slot, 0u, ray.axes),
                                      triangleCorner(slot, 1u, ray.axes), triangleCorner(slot, 2u, ray.axes));
    if (t != kNoHit && t <= trace.hit.t) {
        const uint triangleId = triangleIdOf(slot);
        if (isCloser(t, triangleId, trace.hit)) {
            trace.hit = Hit(t, triangleId);
            trace.slot = slot;
        }
    }
}
#endif
