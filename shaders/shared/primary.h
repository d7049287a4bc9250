// The `primary` integrator: what the camera sees, lit by a lamp at the eye.
#ifndef METAMARCH_SHARED_PRIMARY_H
#define METAMARCH_SHARED_PRIMARY_H
#include "camera.h"
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

struct PrimaryPixel {
    vec3 color; // linear
    float alpha;
    vec3 normal; // geometric, world space, unit length, towards the front of the triangle
    float depth; // along the view axis
    float t;     // along the ray
    uint triangleId;
    uint steps;
    uint tests;
};

// `hit` is not a miss, and of `triangle`.
SHARED_FN PrimaryPixel shadePrimary(const Camera camera, const CameraRay view, const Ray ray, const Hit hit,
                                    const TriangleRecord triangle, const ShadingMaterial material) {
    const vec3 scaled = scaledNormal(triangle.v0, triangle.v1, triangle.v2);
    // Scaled to 1 first: the square of a small triangle's normal would underflow.
    const vec3 normal = unitVector(scaled / largest(abs(scaled)));
    const float cosine = abs(normal.x * view.dir.x + normal.y * view.dir.y + normal.z * view.dir.z);
    const float t = ray.shift + hit.t;
    const float depth =
        t * (view.dir.x * camera.forward.x + view.dir.y * camera.forward.y + view.dir.z * camera.forward.z);
    const vec3 color = material.baseColor * cosine;

    PrimaryPixel pixel;
    pixel.color = color;
    pixel.alpha = 1.0f;
    pixel.normal = normal;
    pixel.depth = depth;
    pixel.t = t;
    pixel.triangleId = hit.triangleId;
    pixel.steps = 0u;
    pixel.tests = 0u;
    return pixel;
}

// Nothing was hit: depth and t are kFarthest here and infinite in the picture.
SHARED_FN PrimaryPixel missPrimary() {
    PrimaryPixel pixel;
    pixel.color = vec3(0.0f);
    pixel.alpha = 0.0f;
    pixel.normal = vec3(0.0f);
    pixel.depth = kFarthest;
    pixel.t = kFarthest;
    pixel.triangleId = kNoTriangle;
    pixel.steps = 0u;
    pixel.tests = 0u;
    return pixel;
}

SHARED_ASSERT_SIZE(PrimaryPush, 8)
SHARED_ASSERT_SIZE(PrimaryPixel, 48)
SHARED_ASSERT_OFFSET(PrimaryPixel, alpha, 12)
SHARED_ASSERT_OFFSET(PrimaryPixel, normal, 16)
SHARED_ASSERT_OFFSET(PrimaryPixel, depth, 28)
SHARED_ASSERT_OFFSET(PrimaryPixel, t, 32)
SHARED_ASSERT_OFFSET(PrimaryPixel, triangleId, 36)
SHARED_ASSERT_OFFSET(PrimaryPixel, steps, 40)
SHARED_ASSERT_OFFSET(PrimaryPixel, tests, 44)

SHARED_END
#endif
