// SPDX-License-Identifier: MIT
// Adaptive sampling: which pixels take further samples.
#pragma once
#include "metamarch/shared/film_data.h"

#include <cstdint>
#include <vector>

namespace metamarch::render {

struct AdaptiveChoice {
    // The error that is good enough: the standard error of a pixel's luminance, divided by the square root of
    // the luminance, as the eye sees noise less in light. 0: every pixel takes all samples.
    double threshold = 0.0;
    std::uint32_t minSamples = 16; // of each pixel, before the first decision

    bool isOn() const { return threshold > 0.0; }
};

// Returns 1 for each pixel that takes a further block, else 0. `film` has the samples before number
// `samples`; pixels with fewer have stopped. Its rows are `width` pixels long.
//
// A pixel does not decide by its own samples. One that stops because its samples happen to agree stops too
// often while its light is not found yet, and pictures become too dark. The squares of a chessboard decide
// for each other: a black pixel stops by the error of the white pixels in its tile and the eight tiles
// around. As samples of different pixels are independent, a pixel's mean stays unbiased but for one thing:
// pixels that have stopped give an error that is less exact, and when they stop depends on the others before.
std::vector<std::uint8_t> activePixels(const FilmData& film, std::uint32_t width, std::uint32_t samples,
                                       double threshold);

} // namespace metamarch::render
