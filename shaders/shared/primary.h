// SPDX-License-Identifier: MIT
// The integrator `primary`: traces only camera rays and shades hits with a lamp at the eye.
#ifndef METAMARCH_SHARED_PRIMARY_H
#define METAMARCH_SHARED_PRIMARY_H
#include "camera.h"
#include "film.h"
#include "scene_layout.h"
#include "tile_order.h"
#include "triangle.h"

SHARED_BEGIN

struct PrimaryPush {
    uint firstPlace;
    TileOrder order;
};

// Returns a pixel with its only sample. The caller adds the ray's counts. `hit` must be a hit of `triangle`.
SHARED_FN FilmPixel shadePrimary(const Camera camera, const CameraRay view, const Ray ray, const Hit hit,
                                 const TriangleRecord triangle, const ShadingMaterial material) {
    const vec3 scaled = scaledNormal(triangle.v0, triangle.v1, triangle.v2);
    FirstHit first = missFirst();
    // Scale it to 1 first, because the square of a small triangle's normal would underflow.
    first.normal = unitVector(scaled / largest(abs(scaled)));
    first.t = ray.shift + hit.t;
    first.depth = first.t * dotProduct(view.dir, camera.forward);
    first.triangleId = hit.triangleId;
    return onlySample(material.baseColor * abs(dotProduct(first.normal, view.dir)), first);
}

SHARED_FN FilmPixel missPrimary() { return onlySample(vec3(0.0f), missFirst()); }

SHARED_ASSERT_SIZE(PrimaryPush, 20)

SHARED_END
#endif
