// SPDX-License-Identifier: MIT
// Compares two pictures.
#pragma once
#include "metamarch/image/image.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

struct ComparisonBounds {
    double maxAbs = 0.0;         // a pixel fails if one of its judged channels differs by more
    double maxFailPercent = 0.0; // the pictures differ if more of their pixels fail
};

// Compares one channel over all pixels; b is the reference. Whole numbers are compared exactly. Equal values,
// equal infinities and two NaNs differ by 0. One infinity, two opposite infinities or one NaN differ by
// infinity, so that they neither cancel nor vanish.
struct ChannelComparison {
    std::string name;
    bool isOfIds = false; // whole numbers
    bool judged = true;
    double rmse = 0.0;
    double relativeMse = 0.0; // mean of (a - b)^2 / (b^2 + 0.01): see kRelativeMseFloor
    // Mean of a - b, which distinguishes a bias from noise; NaN if there are infinities of both signs.
    double meanDifference = 0.0;
    double maxDifference = 0.0; // largest |a - b|, found first at pixel worstX, worstY
    int worstX = 0;
    int worstY = 0;
    double worstA = 0.0;
    double worstB = 0.0;
    std::uint64_t failingPixels = 0;
    double failingPercent = 0.0;
};

struct Comparison {
    bool passed = false;
    // The reasons why the pictures cannot be equal: different sizes, a channel that only one has, a channel
    // of whole numbers in only one.
    std::vector<std::string> mismatches;
    // The channels that both have, in the order of a; none if the sizes differ.
    std::vector<ChannelComparison> channels;
    std::uint64_t pixels = 0;
    std::uint64_t failingPixels = 0; // a pixel counts once, however many of its channels fail
    double failingPercent = 0.0;
};

// Relative error after Rousselle, Knaus and Zwicker, "Adaptive Sampling and Reconstruction using Greedy Error
// Minimization", 2011. The floor keeps nearly black pixels from deciding alone.
inline constexpr double kRelativeMseFloor = 0.01;

// Returns false for channels that count work (AovKind::work). Comparisons report but never judge these, and
// one of the pictures may lack them.
bool isJudged(std::string_view channel);

Comparison compareImages(const Image& a, const Image& b, const ComparisonBounds& bounds = {});

// Returns |a - b| for every channel that both have. The sizes must be equal.
Image differenceImage(const Image& a, const Image& b);

} // namespace metamarch
