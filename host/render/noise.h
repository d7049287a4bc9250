// SPDX-License-Identifier: MIT
// How noisy the pixels of a film are.
#pragma once
#include "metamarch/shared/film_data.h"

#include <optional>

namespace metamarch::render {

struct Luminance {
    double mean;     // over a pixel's samples
    double variance; // of one sample
};

// It takes the deviations of the three channels as fully correlated: a path's noise has the colour of its
// light. Nothing for fewer than two samples.
std::optional<Luminance> luminanceOf(const FilmPixel& pixel);

// Returns the standard error of a pixel's luminance, as the root of its mean square over the picture,
// relative to the mean luminance. It takes the samples for independent: stratified ones have less noise.
// Nothing for pixels of one sample, and for a black picture.
std::optional<double> noiseOf(const FilmData& film);

} // namespace metamarch::render
