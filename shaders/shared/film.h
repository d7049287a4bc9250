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

// A block is the samples [k * kBlockSamples, (k + 1) * kBlockSamples) of a pixel. Sums of floats depend on
// their order, so this order is fixed: a block's sum begins empty and gains its samples in their order, and a
// pixel's sum gains its blocks in their order. However a render is divided, in time or in parts, its sums
// have the same bits.
const uint kBlockSamples = 16u;

// Sums over samples of a pixel.
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

// Returns the sum of a pixel's earlier blocks and of the block after them. What `sum` holds does not matter
// if its number of samples is 0.
SHARED_FN FilmPixel addPixel(const FilmPixel sum, const FilmPixel block) {
    FilmPixel added = sum;
    added.radiance = sum.radiance + block.radiance;
    added.squares = sum.squares + block.squares;
    added.samples = sum.samples + block.samples;
    added.rejected = sum.rejected + block.rejected;
    added.seen.albedo = sum.seen.albedo + block.seen.albedo;
    added.seen.normal = sum.seen.normal + block.seen.normal;
    added.seen.shadingNormal = sum.seen.shadingNormal + block.seen.shadingNormal;
    added.covered = sum.covered + block.covered;
    added.rays = sum.rays + block.rays;
    added.shadowRays = sum.shadowRays + block.shadowRays;
    added.steps = sum.steps + block.steps;
    added.tests = sum.tests + block.tests;
    if (sum.samples == 0u) {
        added = block;
    }
    return added;
}

// Returns the pixel's colour: the mean over the samples that were not rejected.
SHARED_FN vec3 meanRadiance(const FilmPixel pixel) {
    return pixel.radiance / float(max(pixel.samples - pixel.rejected, 1u));
}

// Returns the part of the pixel that something covers, from 0 to 1.
SHARED_FN float coverage(const FilmPixel pixel) {
    return pixel.covered / float(max(pixel.samples - pixel.rejected, 1u));
}

// The light of samples in parts. The film has these sums only if kFilmLight is asked.
//
// emission, direct and indirect are the radiance, by the number of surfaces that scattered the light. A
// sample whose camera ray meets the shadow catcher is in the other sums: those of its shadow, or those of
// what it mirrors, whose light is also in direct and indirect. Shadow is the quotient of two sums, so they
// are kept apart until the end.
struct LightParts {
    vec3 emission;       // by none: lights and surroundings as the camera sees them
    float caught;        // number of samples that met the shadow catcher
    vec3 direct;         // by one
    float mirrored;      // the catcher's reflectance, over the samples that met an object in its mirror
    vec3 indirect;       // by more than one
    float mirrorSamples; // number of samples that followed the mirror
    vec3 reached;        // what a white catcher reflects
    float padding0;
    vec3 unblocked; // what it would reflect if the lights were there without the objects
    float padding1;
    vec3 behind; // radiance of what the camera sees behind the catcher
    float padding2;
};

SHARED_FN LightParts makeLightParts(const vec3 emission, const vec3 direct, const vec3 indirect) {
    return LightParts(emission, 0.0f, direct, 0.0f, indirect, 0.0f, vec3(0.0f), 0.0f, vec3(0.0f), 0.0f,
                      vec3(0.0f), 0.0f);
}

SHARED_FN LightParts noLight() { return makeLightParts(vec3(0.0f), vec3(0.0f), vec3(0.0f)); }

// Returns the light of one sample that met the shadow catcher and measured its shadow.
SHARED_FN LightParts caughtLight(const vec3 reached, const vec3 unblocked, const vec3 behind) {
    return LightParts(vec3(0.0f), 1.0f, vec3(0.0f), 0.0f, vec3(0.0f), 0.0f, reached, 0.0f, unblocked, 0.0f,
                      behind, 0.0f);
}

// Returns the light of one sample that met the shadow catcher and followed its mirror. `parts` is the light
// that it found there.
SHARED_FN LightParts mirroredLight(const LightParts parts, const float mirrored, const vec3 behind) {
    return LightParts(parts.emission, 1.0f, parts.direct, mirrored, parts.indirect, 1.0f, vec3(0.0f), 0.0f,
                      vec3(0.0f), 0.0f, behind, 0.0f);
}

// Adds light that `scatterings` surfaces have scattered.
SHARED_FN LightParts addLight(const LightParts parts, const uint scatterings, const vec3 light) {
    LightParts added = parts;
    if (scatterings == 0u) {
        added.emission = parts.emission + light;
    } else if (scatterings == 1u) {
        added.direct = parts.direct + light;
    } else {
        added.indirect = parts.indirect + light;
    }
    return added;
}

SHARED_FN LightParts addParts(const LightParts a, const LightParts b) {
    return LightParts(a.emission + b.emission, a.caught + b.caught, a.direct + b.direct,
                      a.mirrored + b.mirrored, a.indirect + b.indirect, a.mirrorSamples + b.mirrorSamples,
                      a.reached + b.reached, 0.0f, a.unblocked + b.unblocked, 0.0f, a.behind + b.behind,
                      0.0f);
}

// Does for their light what addPixel does for `sum` and the block after it.
SHARED_FN LightParts addPixelLight(const FilmPixel sum, const LightParts light, const LightParts ofBlock) {
    LightParts added = addParts(light, ofBlock);
    if (sum.samples == 0u) {
        added = ofBlock;
    }
    return added;
}

// Adds a sample's light. Like addSample, it leaves out a sample of which `radiance` is rejected.
SHARED_FN LightParts addSampleLight(const LightParts sum, const vec3 radiance, const LightParts light) {
    LightParts added = addParts(sum, light);
    if (!isWithin(radiance, kLargestRadiance)) {
        added = sum;
    }
    return added;
}

// Bits of what a film has besides FilmPixel. They are a specialization constant of the kernels, so that what
// nobody asks for costs nothing.
const uint kSpecFilm = 4u;
const uint kFilmLight = 1u; // LightParts
const uint kFilmHits = 2u;  // the triangle of each sample's first hit, for counting

// Bindings of the kernels `path`, `add_block` and `resolve`. A film on a device is two: kBindOutput has the
// sums of the last block of each pixel, which gains samples, and kBindTotal those of all blocks before it.
// They begin as a pixel of which only the number of samples, 0, is written.
const uint kBindTotal = 46u;
const uint kBindLight = 47u;
const uint kBindTotalLight = 48u;
const uint kBindHits = 49u; // kBlockSamples words for each pixel

SHARED_ASSERT_SIZE(LightParts, 96)
SHARED_ASSERT_OFFSET(LightParts, direct, 16)
SHARED_ASSERT_OFFSET(LightParts, mirrored, 28)
SHARED_ASSERT_OFFSET(LightParts, mirrorSamples, 44)
SHARED_ASSERT_OFFSET(LightParts, indirect, 32)
SHARED_ASSERT_OFFSET(LightParts, reached, 48)
SHARED_ASSERT_OFFSET(LightParts, unblocked, 64)
SHARED_ASSERT_OFFSET(LightParts, behind, 80)
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
