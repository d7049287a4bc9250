// SPDX-License-Identifier: MIT
// Loads the triangle records, the largest array of a scene.
#ifndef METAMARCH_LIB_TRIANGLES_GLSL
#define METAMARCH_LIB_TRIANGLES_GLSL
#include "lib/memory.glsl"
#include "shared/scene_layout.h"

#if METAMARCH_TEXEL_BUFFERS
WORDS4(triangleWords, kBindTriangles);

TriangleRecord loadTriangle(const uint recordIndex) {
    const uvec4 a = LOAD4(triangleWords, 3u * recordIndex);
    const uvec4 b = LOAD4(triangleWords, 3u * recordIndex + 1u);
    const uvec4 c = LOAD4(triangleWords, 3u * recordIndex + 2u);
    return TriangleRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz),
                          c.w);
}
#else
// On some devices storage buffers are shorter than texel buffers, so the records are cut into chunks. A
// branch chooses the chunk, because an array of buffers with an index that differs between invocations needs
// a feature that lavapipe 22.3 lacks.
layout(constant_id = kSpecTriangleChunks) const uint triangleChunks = 1u;
layout(constant_id = kSpecTrianglesPerChunk) const uint trianglesPerChunk = 0xffffffffu;

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

TriangleRecord loadTriangle(const uint recordIndex) {
    if (triangleChunks == 1u) {
        return triangles0[recordIndex];
    }
    const uint chunk = recordIndex / trianglesPerChunk;
    const uint i = recordIndex - chunk * trianglesPerChunk;
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
#endif
#endif
