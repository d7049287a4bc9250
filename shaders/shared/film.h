// SPDX-License-Identifier: MIT
// The sums that an integrator collects for a pixel. src/image/aov.cpp makes the channels of a picture from
// them.
#ifndef METAMARCH_SHARED_FILM_H
#define METAMARCH_SHARED_FILM_H
#include "ray.h"
#include "scene_layout.h"

SHARED_BEGIN

// The surface that a camera ray hits, for the channels other than the colour. A pixel holds the sums of the
// vectors over its samples, and the scalars of its first sample.
struct FirstHit {
    vec3 albedo;
    float t;     // kFarthest for a miss
    vec3 normal; // geometric
    uint triangleId;
    vec3 shadingNormal;
    float depth; // along the view axis
};

SHARED_FN FirstHit missFirst() {
    return FirstHit(vec3(0.0f), kFarthest, vec3(0.0f), kNoTriangle, vec3(0.0f), kFarthest);
}

// The largest radiance of a sample; larger ones are rejected. The sums of squares stay finite.
const float kLargestRadiance = 1.0e15f;

// Sums over the samples of a pixel. Samples are added in their order, so that the sums do not depend on how
// the work is divided.
struct FilmPixel {
    vec3 radiance;
    uint samples;  // number of samples taken, with rejected ones
    vec3 squares;  // squared radiance
    uint rejected; // number of samples whose radiance was not finite or too large; they are in no sum
    FirstHit seen;
    float covered; // number of samples that hit something
    uint rays;
    uint shadowRays;
    float steps; // of all rays
    float tests;
    uint padding0;
    uint padding1;
    uint padding2;
};

SHARED_FN FilmPixel emptyPixel() {
    return FilmPixel(vec3(0.0f), 0u, vec3(0.0f), 0u, missFirst(), 0.0f, 0u, 0u, 0.0f, 0.0f, 0u, 0u, 0u);
}

// Returns a pixel with this sample only. The sample is not added to 0, because drivers may fold that sum, and
// then -0 would stay -0 on one side.
SHARED_FN FilmPixel onlySample(const vec3 radiance, const FirstHit first) {
    return FilmPixel(radiance, 1u, radiance * radiance, 0u, first,
                     first.triangleId == kNoTriangle ? 0.0f : 1.0f, 0u, 0u, 0.0f, 0.0f, 0u, 0u, 0u);
}

SHARED_FN FilmPixel addSample(const FilmPixel sum, const vec3 radiance, const FirstHit first) {
    FilmPixel added = sum;
    const bool isSound = isWithin(radiance, kLargestRadiance);
    if (isSound) {
        added.radiance = sum.radiance + radiance;
        added.squares = sum.squares + radiance * radiance;
        added.seen.albedo = sum.seen.albedo + first.albedo;
        added.seen.normal = sum.seen.normal + first.normal;
        added.seen.shadingNormal = sum.seen.shadingNormal + first.shadingNormal;
        added.covered = sum.covered + (first.triangleId == kNoTriangle ? 0.0f : 1.0f);
    }
    added.rejected = sum.rejected + (isSound ? 0u : 1u);
    added.samples = sum.samples + 1u;
    if (sum.samples == 0u) {
        added.seen.depth = first.depth;
        added.seen.t = first.t;
        added.seen.triangleId = first.triangleId;
    }
    return added;
}

// Returns the pixel's colour: the mean over the samples that were not rejected.
SHARED_FN vec3 meanRadiance(const FilmPixel pixel) {
    return pixel.radiance / float(max(pixel.samples - pixel.rejected, 1u));
}

SHARED_ASSERT_SIZE(FirstHit, 48)
SHARED_ASSERT_OFFSET(FirstHit, normal, 16)
SHARED_ASSERT_OFFSET(FirstHit, shadingNormal, 32)
SHARED_ASSERT_SIZE(FilmPixel, 112)
SHARED_ASSERT_OFFSET(FilmPixel, squares, 16)
SHARED_ASSERT_OFFSET(FilmPixel, seen, 32)
SHARED_ASSERT_OFFSET(FilmPixel, covered, 80)
SHARED_ASSERT_OFFSET(FilmPixel, steps, 92)

SHARED_END
#endif
