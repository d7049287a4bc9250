// What the path tracer collects of a pixel.
#ifndef METAMARCH_SHARED_FILM_H
#define METAMARCH_SHARED_FILM_H
#include "shared/path.h"

SHARED_BEGIN

// What is the same for all invocations, one uniform buffer: with four of them in a kernel, lavapipe (Mesa
// 22.3.6) writes past its stack.
struct PathInput {
    Camera camera;
    PathSettings settings;
};

// A sample beyond this is no light: the squares of samples are to stay finite.
const float kLargestRadiance = 1.0e15f;

// Pixels are worked on in tiles of kTilePixels (primary.h).
struct PathPush {
    uint firstTile;
    uint tilesPerRow;
    uint endSample; // each pixel takes its samples up to this one
    uint bandTile;  // the film on the device starts with this one
};

// The sums of a pixel's samples in their order, so that they do not depend on how the work is cut.
struct FilmPixel {
    vec3 radiance;
    uint samples; // taken, rejected ones included
    vec3 albedo;
    uint rejected; // samples that were not finite; in no sum
    vec3 normal;   // geometric
    float depth;   // of the first sample, along the view axis; kFarthest: nothing
    vec3 shadingNormal;
    float t;         // of the first sample, along the ray
    vec3 squares;    // of radiances
    float covered;   // samples that hit something
    uint triangleId; // of the first sample
    uint rays;
    uint shadowRays;
    uint padding0;
    float steps; // of all rays
    float tests;
    uint padding1;
    uint padding2;
};

SHARED_FN FilmPixel emptyPixel() {
    return FilmPixel(vec3(0.0f), 0u, vec3(0.0f), 0u, vec3(0.0f), kFarthest, vec3(0.0f), kFarthest, vec3(0.0f),
                     0.0f, kNoTriangle, 0u, 0u, 0u, 0.0f, 0.0f, 0u, 0u);
}

SHARED_FN FilmPixel addSample(const FilmPixel sum, const vec3 radiance, const FirstHit first) {
    FilmPixel added = sum;
    const bool isSound = isWithin(radiance, kLargestRadiance);
    if (isSound) {
        added.radiance = sum.radiance + radiance;
        added.squares = sum.squares + radiance * radiance;
        added.albedo = sum.albedo + first.albedo;
        added.normal = sum.normal + first.normal;
        added.shadingNormal = sum.shadingNormal + first.shadingNormal;
        added.covered = sum.covered + (first.triangleId == kNoTriangle ? 0.0f : 1.0f);
    }
    added.rejected = sum.rejected + (isSound ? 0u : 1u);
    added.samples = sum.samples + 1u;
    if (sum.samples == 0u) {
        added.depth = first.depth;
        added.t = first.t;
        added.triangleId = first.triangleId;
    }
    return added;
}

SHARED_ASSERT_SIZE(PathInput, 208)
SHARED_ASSERT_OFFSET(PathInput, settings, 128)
SHARED_ASSERT_SIZE(PathPush, 16)
SHARED_ASSERT_SIZE(FilmPixel, 112)
SHARED_ASSERT_OFFSET(FilmPixel, albedo, 16)
SHARED_ASSERT_OFFSET(FilmPixel, normal, 32)
SHARED_ASSERT_OFFSET(FilmPixel, shadingNormal, 48)
SHARED_ASSERT_OFFSET(FilmPixel, squares, 64)
SHARED_ASSERT_OFFSET(FilmPixel, triangleId, 80)
SHARED_ASSERT_OFFSET(FilmPixel, steps, 96)

SHARED_END
#endif
