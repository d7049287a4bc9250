// Pearson's chi-square test of samples against the densities they claim.
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace metamarch {

// Two histograms of the same cells.
struct Histogram {
    std::vector<double> observed;
    std::vector<double> expected;
};

// Nothing observed yet, `samples` expected evenly over all cells.
Histogram evenHistogram(std::size_t cells, int samples);

// Into which of that many equal parts of [0, 1] `place` falls; into the outermost from beyond.
std::size_t partOf(double place, std::size_t parts);

// The probability that samples of the expected distribution differ as much as these do. Cells expected to
// hold fewer than 5 are put together, smallest first.
double chiSquareProbability(const Histogram& histogram);

// The significance that each of `tests` tests must have for all of them to fail by chance once in a thousand
// runs (Sidak's correction).
double significanceOf(int tests);

// What a sampler draws: a direction, or nothing (it was absorbed, or has no density).
struct DrawnDirection {
    bool isCounted;
    glm::vec3 direction;
};

// Samples of the sphere, `count` of them, against the density per solid angle: cells of equal cosine and
// azimuth around the z axis, and one for what is not counted.
Histogram sphereHistogram(int count, const std::function<DrawnDirection()>& draw,
                          const std::function<double(glm::vec3)>& density);

} // namespace metamarch
