// SPDX-License-Identifier: MIT
// Pearson's chi-square test of samples against their claimed densities.
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace metamarch {

// Two histograms over the same cells.
struct Histogram {
    std::vector<double> observed;
    std::vector<double> expected;
};

// Returns a histogram without observations. It expects `samples` samples, uniformly over all cells.
Histogram evenHistogram(std::size_t cells, int samples);

// Returns the index of the one of `parts` equal parts of [0, 1] that contains `place`. Values outside go to
// the outermost parts.
std::size_t partOf(double place, std::size_t parts);

// Returns the probability that samples of the expected distribution differ at least as much as these. Cells
// with fewer than 5 expected samples are merged, smallest first.
double chiSquareProbability(const Histogram& histogram);

// Returns the significance that each of `tests` tests must have for any of them to fail by chance only once
// in a thousand runs (Sidak's correction).
double significanceOf(int tests);

// A sampler's result: a direction, or nothing (absorbed, or without a density).
struct DrawnDirection {
    bool isCounted;
    glm::vec3 direction;
};

// Compares `count` samples of the sphere with the density per solid angle. The cells have equal ranges of
// cosine and azimuth around the z axis; one more cell holds the samples that are not counted.
Histogram sphereHistogram(int count, const std::function<DrawnDirection()>& draw,
                          const std::function<double(glm::vec3)>& density);

} // namespace metamarch
