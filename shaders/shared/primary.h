// SPDX-License-Identifier: MIT
// The `primary` integrator: what the camera sees, lit by a lamp at the eye.
#ifndef METAMARCH_SHARED_PRIMARY_H
#define METAMARCH_SHARED_PRIMARY_H
#include "camera.h"
#include "film.h"
#include "scene_layout.h"
#include "triangle.h"

SHARED_BEGIN

// Pixels are worked on in square tiles, so that neighbouring invocations trace neighbouring rays.
const uint kTileSide = 8u;
const uint kTilePixels = 64u;

struct PrimaryPush {
    uint firstTile; // tiles are numbered in rows
    uint tilesPerRow;
};

// The pixel's only sample; what its ray took is still to be added. `hit` is not a miss, and of `triangle`.
SHARED_FN FilmPixel shadePrimary(const Camera camera, const CameraRay view, const Ray ray, const Hit hit,
                                 const TriangleRecord triangle, const ShadingMaterial material) {
    const vec3 scaled = scaledNormal(triangle.v0, triangle.v1, triangle.v2);
    FirstHit first = missFirst();
    // Scaled to 1 first: the square of a small triangle's normal would underflow.
    first.normal = unitVector(scaled / largest(abs(scaled)));
    first.t = ray.shift + hit.t;
    first.depth = first.t * dotProduct(view.dir, camera.forward);
    first.triangleId = hit.triangleId;
    return onlySample(material.baseColor * abs(dotProduct(first.normal, view.dir)), first);
}

SHARED_FN FilmPixel missPrimary() { return onlySample(vec3(0.0f), missFirst()); }

SHARED_ASSERT_SIZE(PrimaryPush, 8)

SHARED_END
#endif
