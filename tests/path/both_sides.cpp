// SPDX-License-Identifier: MIT
#include "path/both_sides.h"

#include "fixtures/vulkan_environment.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace metamarch::tests {

const std::string kDefaultTraversal(traversals().front());

BothSides::DeviceRender BothSides::onDevice(const std::string& traversal, const PathWork& work,
                                            const Where where, const std::uint32_t mostTiles) const {
    const vulkan::Device& device = vulkan::testDevice();
    const ShadingData primary = makeShadingData(made.scene);
    const render::SceneBuffers buffers =
        where == Where::fasterMemory
            ? render::SceneBuffers(device, structure, primary)
            : render::SceneBuffers(device, structure, primary, device.report().maxStorageBufferRange);
    const render::ShadingBuffers shadingBuffers(device, shading);
    render::DevicePathSampler sampler(device, buffers, shadingBuffers, traversal, ofSampler(work), mostTiles);
    FilmData film = takeSamples(sampler, work.samples);
    return {std::move(film), sampler.counters().submissions};
}

bool isSamePicture(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b) {
    if (a.size() != b.size()) {
        return false;
    }
    double difference = 0.0;
    double brightness = 0.0;
    double variance = 0.0; // of the difference, if the samples were independent
    std::size_t apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double ofA = meanRadiance(a[i]).g;
        const double ofB = meanRadiance(b[i]).g;
        difference += ofA - ofB;
        brightness += ofB;
        apart += std::abs(ofA - ofB) > 0.01 * std::max(ofA, ofB) ? 1 : 0;
        for (const FilmPixel* const pixel : {&a[i], &b[i]}) {
            const double count = std::max(pixel->samples - pixel->rejected, 1u);
            const double mean = meanRadiance(*pixel).g;
            variance += std::max(pixel->squares.g / count - mean * mean, 0.0) / count;
        }
    }
    return std::abs(difference) <= 4.0 * std::sqrt(variance) + 1e-3 * brightness && apart <= a.size() / 20;
}

void expectSameFilm(const std::vector<FilmPixel>& film, const std::vector<FilmPixel>& expected) {
    ASSERT_EQ(film.size(), expected.size());
    if (!vulkan::testDevice().report().keepsBits()) {
        EXPECT_TRUE(isSamePicture(film, expected));
        return;
    }
    std::size_t different = 0;
    for (std::size_t i = 0; i < film.size(); ++i) {
        if (!isSamePixel(film[i], expected[i]) && different++ == 0) {
            ADD_FAILURE() << "pixel " << i << ": radiance " << film[i].radiance.r << " " << film[i].radiance.g
                          << " " << film[i].radiance.b << ", expected " << expected[i].radiance.r << " "
                          << expected[i].radiance.g << " " << expected[i].radiance.b << "; rays "
                          << film[i].rays << ", " << expected[i].rays;
        }
    }
    EXPECT_EQ(different, 0u) << "pixels of " << film.size();
}

void expectSameLight(const std::vector<LightParts>& light, const std::vector<LightParts>& expected) {
    ASSERT_EQ(light.size(), expected.size());
    if (!vulkan::testDevice().report().keepsBits()) {
        const auto sumOf = [](const std::vector<LightParts>& film) {
            glm::dvec4 sum(0.0);
            for (const LightParts& parts : film) {
                sum += glm::dvec4(parts.emission.g, parts.direct.g, parts.indirect.g, parts.reached.g);
            }
            return sum;
        };
        const glm::dvec4 sum = sumOf(light);
        const glm::dvec4 wanted = sumOf(expected);
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(sum[i], wanted[i], 0.02 * wanted[i]) << "part " << i;
        }
        return;
    }
    for (std::size_t i = 0; i < light.size(); ++i) {
        using Words = std::array<std::uint32_t, sizeof(LightParts) / 4>;
        ASSERT_EQ(std::bit_cast<Words>(light[i]), std::bit_cast<Words>(expected[i])) << "pixel " << i;
    }
}

void expectPicture(const std::vector<FilmPixel>& film) {
    std::size_t bright = 0;
    for (const FilmPixel& pixel : film) {
        bright += pixel.radiance.g > 0.0f ? 1 : 0;
    }
    EXPECT_GT(bright, film.size() / 20);
}

} // namespace metamarch::tests
