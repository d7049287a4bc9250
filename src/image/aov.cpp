// SPDX-License-Identifier: MIT
#include "metamarch/image/aov.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>

namespace metamarch {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool isMiss(const FilmPixel& pixel) { return pixel.seen.triangleId == kNoTriangle; }

// counted() is the number of samples in the sums, taken() that of all samples; both are at least 1.
float counted(const FilmPixel& pixel) {
    return static_cast<float>(std::max(pixel.samples - pixel.rejected, 1u));
}
float taken(const FilmPixel& pixel) { return static_cast<float>(std::max(pixel.samples, 1u)); }

// The variance of the pixel's mean, as if its samples were independent. Stratified samples have less.
glm::vec3 varianceOfMean(const FilmPixel& pixel) {
    const float count = counted(pixel);
    const glm::vec3 mean = meanRadiance(pixel);
    const glm::vec3 spread = glm::max(pixel.squares / count - mean * mean, glm::vec3(0.0f));
    return spread / std::max(count - 1.0f, 1.0f);
}

// A channel is the mean over the pixel's samples unless its meaning says otherwise.
constexpr Aov kAovs[] = {
    {"R G B", "radiance, linear", [](const FilmPixel& pixel) { return meanRadiance(pixel); }},
    {"A", "part of the pixel that something covers, 0 to 1",
     [](const FilmPixel& pixel) { return glm::vec3(pixel.covered / counted(pixel)); }},
    {"Z", "distance along the view axis, in units of the scene; infinite where the first sample misses",
     [](const FilmPixel& pixel) { return glm::vec3(isMiss(pixel) ? kInfinity : pixel.seen.depth); }},
    {"t", "distance along the ray, likewise",
     [](const FilmPixel& pixel) { return glm::vec3(isMiss(pixel) ? kInfinity : pixel.seen.t); }},
    {"N.X N.Y N.Z", "geometric normal in world space",
     [](const FilmPixel& pixel) { return pixel.seen.normal / counted(pixel); }},
    {"Ns.X Ns.Y Ns.Z", "shading normal in world space",
     [](const FilmPixel& pixel) { return pixel.seen.shadingNormal / counted(pixel); }, AovWriter::pathTracer},
    {"albedo.R albedo.G albedo.B", "part of white light that the surface reflects",
     [](const FilmPixel& pixel) { return pixel.seen.albedo / counted(pixel); }, AovWriter::pathTracer},
    {"variance.R variance.G variance.B", "variance of the means R G B",
     [](const FilmPixel& pixel) { return varianceOfMean(pixel); }, AovWriter::pathTracer},
    {"id.triangle", "triangle of the first sample, exact up to 16,777,216; -1 for a miss",
     [](const FilmPixel& pixel) {
         return glm::vec3(isMiss(pixel) ? -1.0f : static_cast<float>(pixel.seen.triangleId));
     }},
    {"steps", "table look-ups or nodes visited, of all rays of a sample",
     [](const FilmPixel& pixel) { return glm::vec3(pixel.steps / taken(pixel)); }, AovWriter::everyIntegrator,
     AovKind::work},
    {"tests", "triangle tests, of all rays of a sample",
     [](const FilmPixel& pixel) { return glm::vec3(pixel.tests / taken(pixel)); }, AovWriter::everyIntegrator,
     AovKind::work},
};

} // namespace

std::vector<std::string> Aov::channels() const {
    std::vector<std::string> all;
    std::istringstream words{std::string(names)};
    for (std::string word; words >> word;) {
        all.push_back(word);
    }
    return all;
}

std::span<const Aov> aovs() { return kAovs; }

std::vector<Aov> aovsOf(const AovWriter writer) {
    std::vector<Aov> written;
    std::ranges::copy_if(kAovs, std::back_inserter(written), [&](const Aov& aov) {
        return aov.writer == AovWriter::everyIntegrator || writer == AovWriter::pathTracer;
    });
    return written;
}

std::string aovText() {
    std::size_t width = 0;
    for (const Aov& aov : kAovs) {
        width = std::max(width, aov.names.size());
    }
    std::string text;
    for (const Aov& aov : kAovs) {
        text += fmt::format("{:{}}  {}{}\n", aov.names, width, aov.meaning,
                            aov.writer == AovWriter::pathTracer ? " (not by primary)" : "");
    }
    return text;
}

} // namespace metamarch
