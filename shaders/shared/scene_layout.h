// SPDX-License-Identifier: MIT
// The layout of scene buffers: the host writes these structs, the shaders and the judges read them. A vec3 is
// always followed by one 4-byte scalar, so std430, scalar and C++ agree on every offset.
#ifndef METAMARCH_SHARED_SCENE_LAYOUT_H
#define METAMARCH_SHARED_SCENE_LAYOUT_H
#include "interop.h"

SHARED_BEGIN

const uint kNoTriangle = 0xffffffffu;
// The largest resolution per axis: packCell has 10 bits per axis, and a box's `hi` is exclusive.
const uint kMaxLatticeResolution = 1023u;

// Binding numbers of the scene's buffers (set 0). A kernel has those that it and its traversal declare.
const uint kBindLattice = 0u; // uniform
const uint kBindLeaves = 1u;
const uint kBindTable = 2u;
const uint kBindMaterialOfTriangle = 3u;
const uint kBindMaterials = 4u;
const uint kBindCamera = 5u;
const uint kBindInput = 6u;     // input of a kernel besides the scene
const uint kBindOutput = 7u;    // output of a kernel
const uint kBindTriangles = 8u; // the first of kTriangleChunks bindings
const uint kBindKdNodes = 16u;
const uint kBindKdParents = 17u;
const uint kBindKdRopes = 18u;
const uint kBindBvhNodes = 19u;
const uint kBindGrid = 20u; // uniform
const uint kBindGridCells = 21u;
const uint kBindKnownRecords = 22u; // kernel `floor`: the record that each ray hits
const uint kBindBoxes = 23u;        // traversal `ray_query`: the driver's hierarchy over the records' boxes
const uint kBindRectilinear = 24u;  // uniform
const uint kBindPlanes = 25u;
const uint kBindBuckets = 26u;

// The triangle records are the largest array of a scene. If it exceeds a device's maxStorageBufferRange, it
// is cut into up to this number of buffers of equal size.
const uint kTriangleChunks = 8u;

// Specialization constants.
const uint kSpecTriangleChunks = 0u;    // number of chunks in use, 1..kTriangleChunks
const uint kSpecTrianglesPerChunk = 1u; // number of records in each chunk but the last
const uint kSpecAnyHit = 2u;            // kernel `rays`: 1 finds any hit, 0 the closest

// The uniform lattice over the scene box. Geometry is inside, at least kBoxPadding from every face.
struct Lattice {
    vec3 origin;        // world space
    float extent;       // longest side of the lattice in world units
    vec3 cellsPerUnit;  // world to lattice space: (p - origin) * cellsPerUnit
    uint cellCount;     // product of the resolution
    uvec3 resolution;   // 1..kMaxLatticeResolution
    uint triangleCount; // without degenerate triangles
};

// One leaf: the box of whole cells [lo, hi) that a ray may cross once the leaf is tested, and its triangle
// records, which are adjacent in memory.
struct Leaf {
    uint lo; // packCell
    uint hi; // packCell, exclusive
    uint firstTriangle;
    uint triangleCount;
};

// One triangle as every traversal reads it, in world space. Corners are vec3 and not single words, because on
// lavapipe each load costs the same, whatever its size.
struct TriangleRecord {
    vec3 v0;
    uint triangleId;
    vec3 v1;
    uint padding0;
    vec3 v2;
    uint padding1;
};

// The part of a material that the integrator `primary` reads.
struct ShadingMaterial {
    vec3 baseColor; // linear
    float alpha;
};

SHARED_FN uint packCell(const uvec3 cell) { return cell.x | (cell.y << 10u) | (cell.z << 20u); }

SHARED_FN ivec3 unpackCell(const uint packedCell) {
    return ivec3(int(packedCell & 1023u), int((packedCell >> 10u) & 1023u), int(packedCell >> 20u));
}

SHARED_FN uint cellIndex(const ivec3 cell, const uvec3 resolution) {
    return (uint(cell.z) * resolution.y + uint(cell.y)) * resolution.x + uint(cell.x);
}

SHARED_ASSERT_SIZE(Lattice, 48)
SHARED_ASSERT_OFFSET(Lattice, extent, 12)
SHARED_ASSERT_OFFSET(Lattice, cellsPerUnit, 16)
SHARED_ASSERT_OFFSET(Lattice, cellCount, 28)
SHARED_ASSERT_OFFSET(Lattice, resolution, 32)
SHARED_ASSERT_OFFSET(Lattice, triangleCount, 44)
SHARED_ASSERT_SIZE(Leaf, 16)
SHARED_ASSERT_OFFSET(Leaf, hi, 4)
SHARED_ASSERT_OFFSET(Leaf, firstTriangle, 8)
SHARED_ASSERT_OFFSET(Leaf, triangleCount, 12)
SHARED_ASSERT_SIZE(TriangleRecord, 48)
SHARED_ASSERT_OFFSET(TriangleRecord, triangleId, 12)
SHARED_ASSERT_OFFSET(TriangleRecord, v1, 16)
SHARED_ASSERT_OFFSET(TriangleRecord, v2, 32)
SHARED_ASSERT_SIZE(ShadingMaterial, 16)
SHARED_ASSERT_OFFSET(ShadingMaterial, alpha, 12)

SHARED_END
#endif
