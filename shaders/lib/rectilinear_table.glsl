// SPDX-License-Identifier: MIT
// Loads the rectilinear table: planes, buckets along the axes, and the meta table over the cells between
// planes.
#ifndef METAMARCH_LIB_RECTILINEAR_TABLE_GLSL
#define METAMARCH_LIB_RECTILINEAR_TABLE_GLSL
#include "lib/meta_table.glsl"
#include "shared/rectilinear.h"

layout(std140, binding = kBindRectilinear) uniform RectilinearBuffer { Rectilinear rectilinear; };
WORDS1(planeWords, kBindPlanes);
WORDS1(cellOfBucket, kBindBuckets);

float loadPlane(const uint index) { return uintBitsToFloat(LOAD1(planeWords, index)); }

vec3 loadPlanes(const ivec3 planes) {
    const uvec3 indices = rectilinear.firstPlane + uvec3(planes);
    return vec3(loadPlane(indices.x), loadPlane(indices.y), loadPlane(indices.z));
}

// Returns the index of the last plane that is not behind `position`, which is the cell that contains it.
int searchPlane(const float position, const uint firstPlane, const uint bucket) {
    uint cell = LOAD1(cellOfBucket, bucket);
    while (loadPlane(firstPlane + cell + 1u) <= position) {
        ++cell;
    }
    return int(cell);
}

// Returns the cell at `position`. It may be outside the lattice because of rounding.
ivec3 searchCell(const vec3 position) {
    const vec3 scale = rectilinear.bucketsPerUnit;
    const uvec3 last = rectilinear.lastBucket;
    const uvec3 bucket = rectilinear.firstBucket + uvec3(bucketAt(position.x, scale.x, last.x),
                                                         bucketAt(position.y, scale.y, last.y),
                                                         bucketAt(position.z, scale.z, last.z));
    const uvec3 first = rectilinear.firstPlane;
    return ivec3(searchPlane(position.x, first.x, bucket.x), searchPlane(position.y, first.y, bucket.y),
                 searchPlane(position.z, first.z, bucket.z));
}
#endif
