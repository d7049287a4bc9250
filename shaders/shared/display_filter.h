// SPDX-License-Identifier: MIT
// The filter of a window's picture that has few samples yet. It is for the eye alone: no film is
// filtered.
//
// Light is averaged over neighbours that show the same surface, in passes with twice the distance each
// (à-trous wavelets: H. Dammertz, D. Sewtz, J. Hanika, H. Lensch, "Edge-Avoiding À-Trous Wavelet Transform
// for fast Global Illumination Filtering", HPG 2010). How much the light of neighbours may differ follows
// from its variance (C. Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017). Albedo is
// divided out before and multiplied in afterwards, so textures stay sharp.
#ifndef METAMARCH_SHARED_DISPLAY_FILTER_H
#define METAMARCH_SHARED_DISPLAY_FILTER_H
#include "film.h"
#include "math.h"
#include "tile_order.h"

SHARED_BEGIN

const uint kFilterPasses = 5u; // pass i reads neighbours at a distance of 2^i pixels
const uint kFilterRow = 64u;   // pixels of a row that one workgroup filters
const int kFilterReach = 2;    // of the window that tells the variance of single samples, in pixels

// Where the first sample of a pixel has missed, depth is kNotFiltered: the pixel stays as it is, and no other
// pixel takes its light.
const float kNotFiltered = -1.0f;

struct FilterSurface {
    vec3 albedo;
    float depth; // along the ray of the first sample
};

struct FilterShape {
    vec3 normal;
    float slope; // the change of depth from a pixel to the next
};

struct FilterLight {
    vec3 light;     // radiance / filterAlbedo
    float variance; // of its luminance
};

// The kernel `filter_begin` makes the three of a film's tiles.
struct FilterBeginPush {
    uint firstPlace;
    TileOrder order;
    uint bandPlace; // the first place of the film in the buffers that are bound
    uint width;     // of the film, in pixels
    uint height;
};

// The kernels `filter_variance`, `filter_pass`, `filter_end` and `filter_show` work on rows of pixels.
struct FilterPush {
    uint firstRow;
    uint width;
    uint height;
    uint isSingle; // filter_variance: 1 if pixels have one sample, which tells no variance
    uint distance; // filter_pass: of the neighbours, in pixels
    float
        tolerance; // filter_pass: the difference in light that halves a weight or so, in standard deviations
    float kept;    // filter_end: the part of the filter's change that is shown, 0 to 1
    uint toneOperator; // filter_show
    float scale;       // filter_show: factor of radiance
};

// Bindings. Buffers have one element per pixel, in rows from the top.
const uint kBindFilterSurface = 50u;
const uint kBindFilterShape = 51u;
const uint kBindFilterFrom = 52u;
const uint kBindFilterTo = 53u;

// Black surfaces, such as lamps, are not divided by their albedo.
const float kLeastAlbedo = 0.02f;
SHARED_FN vec3 filterAlbedo(const vec3 albedo) {
    return largest(albedo) > kLeastAlbedo ? max(albedo, vec3(kLeastAlbedo)) : vec3(1.0f);
}

SHARED_FN FilterSurface filterSurface(const FilmPixel pixel) {
    const float count = float(max(pixel.samples - pixel.rejected, 1u));
    return FilterSurface(pixel.seen.albedo / count,
                         pixel.seen.triangleId == kNoTriangle ? kNotFiltered : pixel.seen.t);
}

SHARED_FN FilterShape filterShape(const FilmPixel pixel) {
    return FilterShape(pixel.seen.shadingNormal / float(max(pixel.samples - pixel.rejected, 1u)), 0.0f);
}

// The variance is that of the mean, as if samples were independent; 0 for a single sample.
SHARED_FN FilterLight filterLight(const FilmPixel pixel) {
    const float count = float(max(pixel.samples - pixel.rejected, 1u));
    const vec3 albedo = filterAlbedo(pixel.seen.albedo / count);
    const vec3 mean = pixel.radiance / count;
    const vec3 spread = max(pixel.squares / count - mean * mean, vec3(0.0f));
    return FilterLight(mean / albedo, luminance(spread / (albedo * albedo)) / max(count - 1.0f, 1.0f));
}

// Returns the change of depth per pixel on one axis, from the depths kSlopeReach pixels away. It is the
// smaller one of both sides, so that an edge does not count. Samples lie anywhere in their pixels, so the
// depths of neighbours alone would tell little.
const int kSlopeReach = 2;
SHARED_FN float slopeBetween(const float before, const float here, const float after) {
    const float back = before < 0.0f ? kFarthest : abs(here - before);
    const float on = after < 0.0f ? kFarthest : abs(here - after);
    const float least = min(back, on);
    return least < kFarthest ? least / float(kSlopeReach) : 0.0f;
}

// Returns how much pixel b says about pixel a, from 0 to 1, by their surfaces and by `difference`, that of
// their light.
const float kAlbedoTolerance = 0.4f;
const float kDepthTolerance = 2.0f;   // times what the slope allows, because it is an estimate
const float kDepthRounding = 1.0e-3f; // part of the depth that does not count
SHARED_FN float filterWeight(const FilterSurface surfaceA, const FilterShape shapeA,
                             const FilterSurface surfaceB, const FilterShape shapeB, const float pixels,
                             const float difference) {
    if (surfaceA.depth < 0.0f || surfaceB.depth < 0.0f) {
        return 0.0f;
    }
    // The samples of two pixels may be a pixel further apart than their centres.
    const float allowed =
        kDepthTolerance * shapeA.slope * (pixels + 1.0f) + kDepthRounding * surfaceA.depth + 1.0e-30f;
    const float byDepth = abs(surfaceA.depth - surfaceB.depth) / allowed;
    const float byAlbedo = largest(abs(surfaceA.albedo - surfaceB.albedo)) / kAlbedoTolerance;
    const float cosine = min(max(dotProduct(shapeA.normal, shapeB.normal), 0.0f), 1.0f);
    const float to4 = squared(squared(cosine));
    const float byNormal = squared(squared(squared(squared(to4)))); // cosine^64
    return byNormal * exponential(-(difference + byDepth * byDepth + byAlbedo * byAlbedo));
}

// Returns the difference in light that filterWeight takes.
const float kLeastDeviation = 1.0e-6f;
SHARED_FN float lightDifference(const FilterLight a, const FilterLight b, const float tolerance) {
    return abs(luminance(a.light) - luminance(b.light)) / (tolerance * sqrt(a.variance) + kLeastDeviation);
}

// A weighted mean of light around a pixel. Differences to the pixel are summed, so that a constant stays
// exactly what it is.
struct FilterSum {
    vec3 change;
    float variance;
    float weight;
};

SHARED_FN FilterSum startFilterSum(const FilterLight centre, const float weight) {
    return FilterSum(vec3(0.0f), centre.variance * weight * weight, weight);
}

SHARED_FN FilterSum addTo(const FilterSum sum, const FilterLight centre, const FilterLight other,
                          const float weight) {
    return FilterSum(sum.change + (other.light - centre.light) * weight,
                     sum.variance + other.variance * weight * weight, sum.weight + weight);
}

SHARED_FN FilterLight meanOf(const FilterSum sum, const FilterLight centre) {
    return FilterLight(centre.light + sum.change / sum.weight, sum.variance / (sum.weight * sum.weight));
}

// The part of a 3x3 binomial filter, from 1 in the middle.
SHARED_FN float binomial(const int dx, const int dy) {
    return (dx == 0 ? 1.0f : 0.5f) * (dy == 0 ? 1.0f : 0.5f);
}

SHARED_FN vec3 filteredRadiance(const FilterSurface surface, const FilterLight before,
                                const FilterLight after, const float kept) {
    const vec3 light = before.light + (after.light - before.light) * kept;
    return max(light, vec3(0.0f)) * filterAlbedo(surface.albedo);
}

SHARED_ASSERT_SIZE(FilterSurface, 16)
SHARED_ASSERT_SIZE(FilterShape, 16)
SHARED_ASSERT_SIZE(FilterLight, 16)
SHARED_ASSERT_SIZE(FilterBeginPush, 32)
SHARED_ASSERT_SIZE(FilterPush, 36)

SHARED_END
#endif
