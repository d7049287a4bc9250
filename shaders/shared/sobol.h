// SPDX-License-Identifier: MIT
// Random numbers as a function of pixel, sample, dimension and seed. There is no state, so every tile, crop,
// sample range and device draws the same samples.
//
// Each dimension has its own independent set of points with one or two numbers each. The points are the first
// two dimensions of the Sobol sequence, shuffled, with each coordinate Owen-scrambled. Among any 2^k samples
// of a pixel that start at a multiple of 2^k, every elementary interval of area 2^-k contains one point. B.
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash is from N. Vegdahl, "Building a
// Better LK Hash", 2021.
#ifndef METAMARCH_SHARED_SOBOL_H
#define METAMARCH_SHARED_SOBOL_H
#include "interop.h"

#ifdef __cplusplus
#include <glm/integer.hpp>
namespace metamarch {
using glm::bitfieldReverse;
}
#endif

SHARED_BEGIN

// The dimensions of a path; brackets give the number of random numbers that a dimension has.
const uint kDimensionFilter = 0u; // [2] position in the pixel
const uint kDimensionLens = 1u;   // [2] position on the lens
const uint kDimensionTime = 2u;   // [1] time within the shutter interval
// The dimensions of bounce b are bounceDimension(b, ...); bounce 0 is the first hit.
const uint kBounceLight = 0u;     // [2] choice of the light and of a point on it
const uint kBounceLevel = 1u;     // [1] choice between two texture levels
const uint kBounceLobe = 2u;      // [1] choice of the BSDF's lobe
const uint kBounceDirection = 3u; // [2] direction in the lobe
const uint kBounceRoulette = 4u;  // [1] Russian roulette
const uint kBounceMirror = 4u; // [1] at the first hit, before roulette begins: choice of the catcher's mirror
const uint kBounceChannel = 5u;    // [1] choice of the colour channel that a dispersive volume refracts
const uint kBounceAlpha = 6u;      // [1] whether a triangle on the way to this hit is opaque: see sampleOf
const uint kBounceLightAlpha = 7u; // [1] the same on the way to the light
const uint kDimensionsPerBounce = 8u;
const uint kDimensionFirstBounce = 8u;

SHARED_FN uint bounceDimension(const uint bounce, const uint decision) {
    return kDimensionFirstBounce + bounce * kDimensionsPerBounce + decision;
}

// Identifies one sample of one pixel.
struct PixelSample {
    uint seed;          // hash of the pixel and the render's seed
    uint reversedIndex; // index of the sample, with its bits reversed
};

// A bijection with good avalanche. C. Wellons, "Prospecting for Hash Functions" (lowbias32), 2018.
SHARED_FN uint hashed(const uint x) {
    const uint a = (x ^ (x >> 16u)) * 0x7feb352du;
    const uint b = (a ^ (a >> 15u)) * 0x846ca68bu;
    return b ^ (b >> 16u);
}

SHARED_FN PixelSample makePixelSample(const uint x, const uint y, const uint index, const uint seed) {
    return PixelSample(hashed(x + hashed(y + hashed(seed))), bitfieldReverse(index));
}

// Returns the index of the sample, counted from 0.
SHARED_FN uint sampleIndex(const PixelSample at) { return bitfieldReverse(at.reversedIndex); }

// An Owen scramble on reversed bits: flips each bit by a hash of the bits below it.
SHARED_FN uint scrambledReversed(const uint x, const uint seed) {
    const uint a = x ^ (x * 0x3d20adeau);
    const uint b = (a + seed) * ((seed >> 16u) | 1u);
    const uint c = b ^ (b * 0x05526c56u);
    return c ^ (c * 0x53a22864u);
}

SHARED_FN uint scrambled(const uint x, const uint seed) {
    return bitfieldReverse(scrambledReversed(bitfieldReverse(x), seed));
}

// Computes the second dimension of the Sobol sequence from the first. The matrix is Pascal's triangle modulo
// 2, a Kronecker power of (1 1; 0 1), so a butterfly of five steps multiplies by it.
SHARED_FN uint sobolSecond(const uint first) {
    const uint a = first ^ ((first << 1u) & 0xaaaaaaaau);
    const uint b = a ^ ((a << 2u) & 0xccccccccu);
    const uint c = b ^ ((b << 4u) & 0xf0f0f0f0u);
    const uint d = c ^ ((c << 8u) & 0xff00ff00u);
    return d ^ (d << 16u);
}

// Returns a multiple of 2^-24 in [0, 1); rounding to a float cannot reach 1.
SHARED_FN float unitInterval(const uint bits) { return float(bits >> 8u) * 5.9604644775390625e-8f; }

// Returns the random number of `dimension` for one of several things, each of which has its own. For
// kBounceAlpha, a thing is a triangle, so the order in which triangles are met does not matter.
SHARED_FN float sampleOf(const PixelSample at, const uint dimension, const uint thing) {
    const uint seed = hashed(at.seed ^ hashed(dimension + thing * 0x9e3779b9u));
    const uint point = scrambledReversed(at.reversedIndex, seed);
    return unitInterval(scrambled(point, hashed(seed + 1u)));
}

SHARED_FN float sample1d(const PixelSample at, const uint dimension) { return sampleOf(at, dimension, 0u); }

SHARED_FN vec2 sample2d(const PixelSample at, const uint dimension) {
    const uint seed = hashed(at.seed ^ hashed(dimension));
    const uint first = scrambledReversed(at.reversedIndex, seed);
    const uint second = sobolSecond(first);
    return vec2(unitInterval(scrambled(first, hashed(seed + 1u))),
                unitInterval(scrambled(second, hashed(seed + 2u))));
}

SHARED_END
#endif
