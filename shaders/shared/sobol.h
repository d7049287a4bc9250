// SPDX-License-Identifier: MIT
// Random numbers as a function of pixel, sample, dimension and seed. There is no state, so every tile, crop,
// sample range and device draws the same samples.
//
// Each dimension has its own independent set of points with one or two numbers each. The points are the first
// two dimensions of the Sobol sequence, shuffled, with each coordinate Owen-scrambled. Among any 2^k samples
// of a pixel that start at a multiple of 2^k, every elementary interval of area 2^-k contains one point. B.
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; the hash is from N. Vegdahl, "Building a
// Better LK Hash", 2021.
//
// Neighbouring pixels complement each other. The 16 pixels of a block of 4 x 4 have one scramble, and each
// has a digital shift of its own. The first 2^k samples of all 16 together have one point in every elementary
// interval of area 2^-(k+4), and those of 2 x 2 pixels one in those of area 2^-(k+2). So a mean over pixels
// has less noise than a mean over as many independent samples, and what noise there is has high frequencies.
// The goal is that of A. Ahmed, P. Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error
// via Hierarchical Ordering of Pixels", 2020, whose samplers have to know the number of samples in advance.
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
    uint seed;          // hash of the pixel's block and the render's seed
    uint place;         // of the pixel in its block: bits 0 and 2 are those of x, bits 1 and 3 those of y
    uint reversedIndex; // index of the sample, with its bits reversed
};

// A bijection with good avalanche. C. Wellons, "Prospecting for Hash Functions" (lowbias32), 2018.
SHARED_FN uint hashed(const uint x) {
    const uint a = (x ^ (x >> 16u)) * 0x7feb352du;
    const uint b = (a ^ (a >> 15u)) * 0x846ca68bu;
    return b ^ (b >> 16u);
}

// The matrices that make a pixel's digital shift from the four bits of its place in the block, as columns:
// bits 11 to 6 are the first digits of the first coordinate, bits 5 to 0 those of the second, and both repeat
// after six digits. They were found by a search, and hold for every k from 0 to 28: beside the Sobol
// sequence's matrices for k bits of the index they make a (0, k + 4, 2)-net, and the first two columns alone
// a (0, k + 2, 2)-net.
const uvec4 kShiftDigits = uvec4(0xb5bu, 0x6edu, 0x3d1u, 0xa28u);

// Returns the first six digits of the shift of both coordinates.
SHARED_FN uint shiftDigits(const uint place) {
    return ((0u - (place & 1u)) & kShiftDigits.x) ^ ((0u - ((place >> 1u) & 1u)) & kShiftDigits.y) ^
           ((0u - ((place >> 2u) & 1u)) & kShiftDigits.z) ^ ((0u - (place >> 3u)) & kShiftDigits.w);
}

// Returns the six digits again and again.
SHARED_FN uint repeated(const uint digits) { return digits * 0x04104104u + (digits >> 4u); }
SHARED_FN uint firstShift(const uint digits) { return repeated(digits >> 6u); }
SHARED_FN uint secondShift(const uint digits) { return repeated(digits & 63u); }

SHARED_FN PixelSample makePixelSample(const uint x, const uint y, const uint index, const uint seed) {
    const uint place = (x & 1u) | ((y & 1u) << 1u) | ((x & 2u) << 1u) | ((y & 2u) << 2u);
    return PixelSample(hashed((x >> 2u) + hashed((y >> 2u) + hashed(seed))), place, bitfieldReverse(index));
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

// An Owen scramble on reversed bits of an index that takes 0 to 0. So it takes the first 2^k indices to
// themselves.
SHARED_FN uint shuffledReversed(const uint x, const uint seed) {
    return scrambledReversed(x, seed) ^ scrambledReversed(0u, seed);
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

// Returns the product of b, in [0, 3], and one of the three elements of GF(4) other than 0, which a uniform
// number in [0, 255] chooses. Two bits of the constant are a product, eight are a row of the table.
SHARED_FN uint timesElement(const uint uniform8, const uint b) {
    const uint element = (uniform8 * 3u) >> 8u;
    return (0x9c78e4u >> (8u * element + 2u * b)) & 3u;
}

// Returns which of the block's 16 shifts a pixel takes in a dimension with this seed. The pixels of a quarter
// stay together. Affine maps of GF(4) send every two pixels of a quarter to every two places equally often,
// as every two quarters, so the shifts of two dimensions are not correlated.
SHARED_FN uint shiftedPlace(const uint place, const uint seed) {
    const uint quarter = place >> 2u;
    const uint added = (seed >> (2u * quarter)) & 3u;
    return (timesElement(seed >> 24u, place & 3u) ^ added) |
           (timesElement((seed >> 16u) & 255u, quarter) << 2u);
}

// Returns the first coordinate of the sample's point in a dimension with this seed, before shift and
// scramble. Each pixel takes the points of the block in an order of its own.
SHARED_FN uint pointOf(const PixelSample at, const uint seed) {
    return shuffledReversed(at.reversedIndex, hashed(seed + 2u + at.place));
}

// Returns the random number of `dimension` for one of several things, each of which has its own. For
// kBounceAlpha, a thing is a triangle, so the order in which triangles are met does not matter.
SHARED_FN float sampleOf(const PixelSample at, const uint dimension, const uint thing) {
    const uint seed = hashed(at.seed ^ hashed(dimension + thing * 0x9e3779b9u));
    const uint shift = firstShift(shiftDigits(shiftedPlace(at.place, seed)));
    return unitInterval(scrambled(pointOf(at, seed) ^ shift, hashed(seed)));
}

SHARED_FN float sample1d(const PixelSample at, const uint dimension) { return sampleOf(at, dimension, 0u); }

SHARED_FN vec2 sample2d(const PixelSample at, const uint dimension) {
    const uint seed = hashed(at.seed ^ hashed(dimension));
    const uint first = pointOf(at, seed);
    const uint digits = shiftDigits(shiftedPlace(at.place, seed));
    return vec2(unitInterval(scrambled(first ^ firstShift(digits), hashed(seed))),
                unitInterval(scrambled(sobolSecond(first) ^ secondShift(digits), hashed(seed + 1u))));
}

SHARED_END
#endif
