// SPDX-License-Identifier: MIT
// The sampler: every prefix is stratified, dimensions and pixels are independent, and the error is below that
// of random numbers.
#include "metamarch/shared/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace metamarch {
namespace {

constexpr uint kSeed = 3;

std::vector<vec2> points(uint x, uint y, uint dimension, uint count, uint first = 0, uint seed = kSeed) {
    std::vector<vec2> all(count);
    for (uint i = 0; i < count; ++i) {
        all[i] = sample2d(makePixelSample(x, y, first + i, seed), dimension);
    }
    return all;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - 0.5) * (b[i] - 0.5);
        aa += (a[i] - 0.5) * (a[i] - 0.5);
        bb += (b[i] - 0.5) * (b[i] - 0.5);
    }
    return ab / std::sqrt(aa * bb);
}

// Sobol's own construction: x_i is the xor of the direction numbers of the bits of i. Those of the second
// dimension follow from the primitive polynomial x + 1.
uint sobolSecondByDirectionNumbers(uint index) {
    uint direction = 0x80000000u;
    uint value = 0;
    for (uint bit = 0; bit < 32; ++bit) {
        value ^= (index >> bit) & 1u ? direction : 0u;
        direction ^= direction >> 1u;
    }
    return value;
}

TEST(Sobol, secondDimensionHasItsDirectionNumbers) {
    for (uint index = 0; index < 5000; ++index) {
        ASSERT_EQ(sobolSecond(bitfieldReverse(index)), sobolSecondByDirectionNumbers(index)) << index;
    }
}

// Expects one point in each elementary interval of any shape. The number of points is 2^k.
void expectNet(const std::vector<vec2>& all, uint k) {
    ASSERT_EQ(all.size(), std::size_t{1} << k);
    for (uint columnBits = 0; columnBits <= k; ++columnBits) {
        const auto columns = static_cast<float>(1u << columnBits);
        const auto rows = static_cast<float>(1u << (k - columnBits));
        std::set<std::pair<int, int>> cells;
        for (const vec2& point : all) {
            cells.insert({static_cast<int>(point.x * columns), static_cast<int>(point.y * rows)});
        }
        ASSERT_EQ(cells.size(), all.size()) << columnBits << " of " << k;
    }
}

TEST(Sobol, everyElementaryIntervalHoldsOnePoint) {
    for (uint k = 1; k <= 10; ++k) {
        const uint count = 1u << k;
        // The first samples, and a later, aligned range as a resumed render draws it.
        for (const uint first : {0u, 5u * count}) {
            expectNet(points(17, 4, kDimensionLens, count, first), k);
        }
    }
}

// Returns the rank of binary vectors.
uint rankOf(std::vector<std::uint64_t> vectors) {
    uint rank = 0;
    for (std::uint64_t bit = 1; bit != 0; bit <<= 1u) {
        const auto pivot = std::ranges::find_if(vectors, [&](std::uint64_t v) { return (v & bit) != 0; });
        if (pivot != vectors.end()) {
            const std::uint64_t row = *pivot;
            *pivot = 0;
            for (std::uint64_t& vector : vectors) {
                vector ^= (vector & bit) != 0 ? row : 0;
            }
            ++rank;
        }
    }
    return rank;
}

// Points are a linear function of k bits of the index and some bits of the place. A net is one where the
// function to the first digits of both coordinates can be inverted, however many of them are of the first.
TEST(Sobol, shiftsMakeANetForEveryNumberOfSamples) {
    for (const uint placeBits : {2u, 4u}) {
        for (uint k = 0; k + placeBits <= 32; ++k) {
            std::vector<std::uint64_t> columns;
            for (uint bit = 0; bit < k; ++bit) {
                const uint first = 0x80000000u >> bit;
                columns.push_back(std::uint64_t{first} << 32u | sobolSecond(first));
            }
            for (uint bit = 0; bit < placeBits; ++bit) {
                const uint shift = shiftDigits(1u << bit);
                columns.push_back(std::uint64_t{firstShift(shift)} << 32u | secondShift(shift));
            }
            const uint digits = k + placeBits;
            for (uint ofFirst = 0; ofFirst <= digits; ++ofFirst) {
                const std::uint64_t mask = ~(0xffffffffull >> ofFirst) << 32u |
                                           (0xffffffffull & ~(0xffffffffull >> (digits - ofFirst)));
                std::vector<std::uint64_t> truncated = columns;
                for (std::uint64_t& column : truncated) {
                    column &= mask;
                }
                ASSERT_EQ(rankOf(truncated), digits) << k << ' ' << placeBits << ' ' << ofFirst;
            }
        }
    }
}

// Otherwise products of two dimensions would have the same error in each pixel of a block.
TEST(Sobol, pixelsTakeThePointsInOrdersOfTheirOwn) {
    constexpr uint kCount = 64;
    constexpr uint kSeeds = 256;
    for (const auto& [a, b] : {std::pair{0u, 1u}, {2u, 3u}, {1u, 13u}}) {
        uint same = 0;
        for (uint k = 0; k < kSeeds; ++k) {
            std::set<uint> points;
            for (uint i = 0; i < kCount; ++i) {
                const uint point = pointOf(PixelSample(0, a, bitfieldReverse(i)), hashed(k));
                same += point == pointOf(PixelSample(0, b, bitfieldReverse(i)), hashed(k)) ? 1 : 0;
                points.insert(point >> 26u);
            }
            ASSERT_EQ(points.size(), kCount) << "not the first points of the set";
        }
        // Expected are the first two points and one from each next power of two: 7 of 64.
        EXPECT_NEAR(same / double{kSeeds}, 7.0, 1.5);
    }
}

// Two pixels of a block take every two different places of shifts equally often.
TEST(Sobol, shiftsOfTwoDimensionsAreNotCorrelated) {
    constexpr uint kSeeds = 24000;
    constexpr double kExpected = kSeeds / 12.0;
    for (const auto& [a, b] : {std::pair{0u, 1u}, {2u, 3u}, {12u, 15u}}) { // of one quarter
        std::map<std::pair<uint, uint>, int> times;
        for (uint i = 0; i < kSeeds; ++i) {
            const uint seed = hashed(i);
            ++times[{shiftedPlace(a, seed) & 3u, shiftedPlace(b, seed) & 3u}];
        }
        ASSERT_EQ(times.size(), 12u);
        for (const auto& [places, count] : times) {
            EXPECT_NEAR(count, kExpected, 6.0 * std::sqrt(kExpected)) << places.first << places.second;
        }
    }
    for (uint i = 0; i < 1000; ++i) {
        std::set<uint> places;
        for (uint place = 0; place < 16; ++place) {
            places.insert(shiftedPlace(place, hashed(i)));
            EXPECT_EQ(shiftedPlace(place, hashed(i)) >> 2u, shiftedPlace(place & 12u, hashed(i)) >> 2u);
        }
        EXPECT_EQ(places.size(), 16u);
    }
}

// Samples of all pixels of a block, and of each quarter of it, together.
TEST(Sobol, neighboursShareTheElementaryIntervals) {
    struct Block {
        uint x;
        uint y;
        uint size; // pixels along a side
        uint bits; // log2 of the number of pixels
    };
    for (const Block block :
         {Block{12, 40, 4, 4}, Block{12, 40, 2, 2}, Block{14, 40, 2, 2}, Block{14, 42, 2, 2}}) {
        for (uint k = 0; k <= 7; ++k) {
            std::vector<vec2> all;
            for (uint pixel = 0; pixel < block.size * block.size; ++pixel) {
                const std::vector<vec2> own = points(block.x + pixel % block.size,
                                                     block.y + pixel / block.size, kDimensionLens, 1u << k);
                all.insert(all.end(), own.begin(), own.end());
            }
            expectNet(all, k + block.bits);
        }
    }
}

TEST(Sobol, oneNumberOfNeighboursIsStratified) {
    constexpr uint kCount = 16;
    std::set<int> cells;
    for (uint pixel = 0; pixel < 16; ++pixel) {
        for (uint i = 0; i < kCount; ++i) {
            const PixelSample at = makePixelSample(8 + pixel % 4, pixel / 4, i, kSeed);
            cells.insert(static_cast<int>(sample1d(at, 14) * 16 * kCount));
        }
    }
    EXPECT_EQ(cells.size(), 16 * kCount);
}

TEST(Sobol, oneNumberIsStratifiedToo) {
    constexpr uint kCount = 256;
    for (const uint triangle : {0u, 1u, 77u}) {
        std::set<int> cells;
        for (uint i = 0; i < kCount; ++i) {
            cells.insert(static_cast<int>(sampleOf(makePixelSample(1, 2, i, kSeed), 14, triangle) * kCount));
        }
        EXPECT_EQ(cells.size(), kCount);
    }
}

TEST(Sobol, numbersLieBelowOne) {
    EXPECT_LT(unitInterval(0xffffffffu), 1.0f);
    EXPECT_EQ(unitInterval(0u), 0.0f);
}

TEST(Sobol, dimensionsAndBlocksDoNotCorrelate) {
    // The mean product of a pair of coordinates over many pixels, at sample counts where a bad scramble would
    // repeat its pattern. The bound is six standard deviations.
    constexpr uint kPixels = 4096;
    for (const uint index : {0u, 1u, 2u, 63u}) {
        std::vector<double> here(kPixels);
        std::vector<double> sameSet(kPixels);
        std::vector<double> otherDimension(kPixels);
        std::vector<double> nextBlock(kPixels);
        std::vector<double> nextSample(kPixels);
        std::vector<double> otherThing(kPixels);
        for (uint p = 0; p < kPixels; ++p) {
            const uint x = p % 64;
            const uint y = p / 64;
            const PixelSample at = makePixelSample(x, y, index, kSeed);
            const vec2 point = sample2d(at, 11);
            here[p] = point.x;
            sameSet[p] = point.y;
            otherDimension[p] = sample2d(at, 12).x;
            nextBlock[p] = sample2d(makePixelSample(x + 4, y, index, kSeed), 11).x;
            nextSample[p] = sample2d(makePixelSample(x, y, index + 4, kSeed), 11).x;
            otherThing[p] = sampleOf(at, 11, 1);
        }
        const double bound = 6.0 / std::sqrt(kPixels);
        for (const auto* other : {&sameSet, &otherDimension, &nextBlock, &nextSample, &otherThing}) {
            EXPECT_LT(std::abs(correlation(here, *other)), bound) << index;
        }
    }
}

TEST(Sobol, dimensionsDoNotCorrelateWithinAPixel) {
    constexpr uint kCount = 1024;
    std::vector<std::vector<double>> columns;
    for (uint dimension = 0; dimension < 24; ++dimension) {
        std::vector<double> x;
        std::vector<double> y;
        for (const vec2& point : points(9, 9, dimension, kCount)) {
            x.push_back(point.x);
            y.push_back(point.y);
        }
        columns.push_back(x);
        columns.push_back(y);
    }
    for (std::size_t a = 0; a < columns.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            EXPECT_LT(std::abs(correlation(columns[a], columns[b])), 6.0 / std::sqrt(kCount))
                << a << ' ' << b;
        }
    }
}

TEST(Sobol, numbersAreUniformOverPixels) {
    // Chi-square over 64 cells of the first samples of 2^16 pixels: with 63 degrees of freedom, 120 has a
    // probability of 2e-5.
    std::vector<int> cells(64);
    for (uint y = 0; y < 256; ++y) {
        for (uint x = 0; x < 256; ++x) {
            const vec2 point = sample2d(makePixelSample(x, y, 0, kSeed), kDimensionFilter);
            ++cells[static_cast<std::size_t>(point.x * 8.0f) * 8 + static_cast<std::size_t>(point.y * 8.0f)];
        }
    }
    double chiSquare = 0.0;
    for (const int count : cells) {
        chiSquare += (count - 1024.0) * (count - 1024.0) / 1024.0;
    }
    EXPECT_LT(chiSquare, 120.0);
}

// The root mean square errors over pixels for two integrals: a disc's indicator and a smooth function.
struct Errors {
    double disc = 0.0;
    double smooth = 0.0;
};

template <class Draw>
Errors errorsOf(uint samples, Draw draw) {
    constexpr uint kPixels = 256;
    Errors errors;
    for (uint pixel = 0; pixel < kPixels; ++pixel) {
        double disc = 0.0;
        double smooth = 0.0;
        for (uint i = 0; i < samples; ++i) {
            const vec2 point = draw(pixel, i);
            disc += point.x * point.x + point.y * point.y < 1.0f ? 1.0 : 0.0;
            smooth += std::exp(point.x) * point.y;
        }
        errors.disc += std::pow(disc / samples - M_PI / 4.0, 2.0) / kPixels;
        errors.smooth += std::pow(smooth / samples - (M_E - 1.0) / 2.0, 2.0) / kPixels;
    }
    return {std::sqrt(errors.disc), std::sqrt(errors.smooth)};
}

TEST(Sobol, integratesBetterThanRandomNumbers) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> even;
    for (const uint samples : {64u, 256u}) {
        const Errors sobol = errorsOf(
            samples, [](uint pixel, uint i) { return sample2d(makePixelSample(pixel, 0, i, kSeed), 19); });
        const Errors independent =
            errorsOf(samples, [&](uint, uint) { return vec2(even(random), even(random)); });
        EXPECT_LT(sobol.disc, independent.disc / 2.5) << samples;
        EXPECT_LT(sobol.smooth, independent.smooth / 15.0) << samples;
    }
}

// The mean over a block is as good as one pixel of as many samples, and not as one of independent pixels.
TEST(Sobol, neighboursIntegrateTogether) {
    constexpr uint kSamples = 16;
    const Errors one = errorsOf(
        16 * kSamples, [](uint pixel, uint i) { return sample2d(makePixelSample(pixel, 0, i, kSeed), 19); });
    const Errors block = errorsOf(16 * kSamples, [](uint pixel, uint i) {
        return sample2d(makePixelSample(4 * pixel + i % 4, i / 4 % 4, i / 16, kSeed), 19);
    });
    const Errors apart = errorsOf(16 * kSamples, [](uint pixel, uint i) {
        return sample2d(makePixelSample(4 * (16 * pixel + i % 16), 0, i / 16, kSeed), 19);
    });
    EXPECT_LT(block.disc, 1.2 * one.disc);
    EXPECT_LT(block.smooth, 1.2 * one.smooth);
    EXPECT_LT(2.0 * block.disc, apart.disc);
    EXPECT_LT(2.0 * block.smooth, apart.smooth);
}

TEST(Sobol, seedChangesEveryNumber) {
    const std::vector<vec2> one = points(3, 5, 8, 256, 0, 1);
    const std::vector<vec2> other = points(3, 5, 8, 256, 0, 2);
    int same = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        same += one[i].x == other[i].x || one[i].y == other[i].y ? 1 : 0;
    }
    EXPECT_EQ(same, 0);
}

TEST(Sobol, everyDecisionOfAPathHasItsOwnDimension) {
    std::set<uint> dimensions = {kDimensionFilter, kDimensionLens, kDimensionTime};
    for (uint bounce = 0; bounce < 20; ++bounce) {
        for (uint decision = 0; decision < kDimensionsPerBounce; ++decision) {
            EXPECT_TRUE(dimensions.insert(bounceDimension(bounce, decision)).second);
        }
    }
}

} // namespace
} // namespace metamarch
