// SPDX-License-Identifier: MIT
// The table of channels, and their values for a pixel of the film.
#include "metamarch/image/film_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace metamarch {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

float valueOf(const Image& image, const std::string_view channel) {
    return image.at(0, 0, image.findChannel(channel).value());
}

Image imageOf(const FilmPixel& pixel) { return filmImage({&pixel, 1}, 1, 1, aovs()); }

FirstHit hitAt(const float t) {
    FirstHit hit = missFirst();
    hit.t = t;
    hit.depth = 0.5f * t;
    hit.normal = {0.0f, 1.0f, 0.0f};
    hit.shadingNormal = {0.0f, 0.0f, 1.0f};
    hit.albedo = {0.25f, 0.5f, 0.75f};
    hit.triangleId = 7;
    return hit;
}

TEST(Aov, hasNamesOfItsOwnAndAMeaning) {
    std::set<std::string> all;
    for (const Aov& aov : aovs()) {
        SCOPED_TRACE(aov.names);
        const std::vector<std::string> channels = aov.channels();
        EXPECT_TRUE(channels.size() == 1 || channels.size() == 3) << "channels";
        EXPECT_FALSE(aov.meaning.empty());
        for (const std::string& channel : channels) {
            EXPECT_TRUE(all.insert(channel).second) << channel;
        }
    }
}

TEST(Aov, isListedInTheReadme) {
    std::ifstream file(METAMARCH_SOURCE_DIR "/README.md");
    const std::string readme{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(readme.find("```\n" + aovText() + "```\n"), std::string::npos) << "README.md must say\n\n```\n"
                                                                             << aovText() << "```";
}

TEST(Aov, isWrittenByItsIntegrators) {
    EXPECT_EQ(aovsOf(AovWriter::pathTracer).size(), aovs().size());
    const std::vector<Aov> ofPrimary = aovsOf(AovWriter::everyIntegrator);
    EXPECT_LT(ofPrimary.size(), aovs().size());
    for (const Aov& aov : ofPrimary) {
        EXPECT_EQ(aov.writer, AovWriter::everyIntegrator) << aov.names;
    }
    const Image image = filmImage({}, 0, 0, ofPrimary);
    EXPECT_TRUE(image.findChannel("N.X"));
    EXPECT_FALSE(image.findChannel("albedo.R"));
}

// Adds a hit, a miss and a sample that is not a number.
TEST(Aov, isAMeanOrOfTheFirstSample) {
    FilmPixel pixel = addSample(emptyPixel(), glm::vec3(2.0f, 4.0f, 6.0f), hitAt(8.0f));
    pixel = addSample(pixel, glm::vec3(0.0f), missFirst());
    pixel = addSample(pixel, glm::vec3(kInf), hitAt(1.0f));
    pixel.steps = 30.0f;
    pixel.tests = 6.0f;
    const Image image = imageOf(pixel);
    EXPECT_EQ(valueOf(image, "R"), 1.0f);
    EXPECT_EQ(valueOf(image, "G"), 2.0f);
    EXPECT_EQ(valueOf(image, "B"), 3.0f);
    EXPECT_EQ(valueOf(image, "A"), 0.5f);
    EXPECT_EQ(valueOf(image, "Z"), 4.0f);
    EXPECT_EQ(valueOf(image, "t"), 8.0f);
    EXPECT_EQ(valueOf(image, "N.Y"), 0.5f);
    EXPECT_EQ(valueOf(image, "Ns.Z"), 0.5f);
    EXPECT_EQ(valueOf(image, "albedo.B"), 0.375f);
    EXPECT_EQ(valueOf(image, "variance.R"), 1.0f); // squares 4 and 0, mean 1, two samples
    EXPECT_EQ(valueOf(image, "id.triangle"), 7.0f);
    EXPECT_EQ(valueOf(image, "steps"), 10.0f);
    EXPECT_EQ(valueOf(image, "tests"), 2.0f);
}

TEST(Aov, isInfiniteOrNoIdForAMiss) {
    const Image image = imageOf(addSample(emptyPixel(), glm::vec3(1.0f), missFirst()));
    EXPECT_EQ(valueOf(image, "R"), 1.0f);
    EXPECT_EQ(valueOf(image, "A"), 0.0f);
    EXPECT_EQ(valueOf(image, "Z"), kInf);
    EXPECT_EQ(valueOf(image, "t"), kInf);
    EXPECT_EQ(valueOf(image, "id.triangle"), -1.0f);
    EXPECT_EQ(valueOf(image, "variance.R"), 0.0f);
}

TEST(Aov, isANumberBeforeTheFirstSample) {
    const Image image = imageOf(emptyPixel());
    for (const float value : image.pixels) {
        EXPECT_FALSE(std::isnan(value));
    }
}

} // namespace
} // namespace metamarch
