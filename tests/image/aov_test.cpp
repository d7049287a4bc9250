// SPDX-License-Identifier: MIT
// The table of channels, and their values for a pixel of the film.
#include "fixtures/expect_error.h"
#include "metamarch/image/cryptomatte.h"
#include "metamarch/image/film_image.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace metamarch {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

float valueOf(const Image& image, const std::string_view channel) {
    return image.at(0, 0, image.findChannel(channel).value());
}

std::uint32_t idOf(const Image& image, const std::string_view channel) {
    return image.ids[image.findIdChannel(channel).value()];
}

// With every channel of the table.
Image imageOf(const FilmPixel& pixel, const LightParts& light = noLight(),
              const std::vector<SeenPoint>& seen = {}) {
    FilmData film(1, kFilmLight);
    film.pixels.front() = pixel;
    film.light.front() = light;
    return filmImage(film, seen, 1, 1, aovs());
}

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
        EXPECT_TRUE(channels.size() >= 1 && channels.size() <= 3) << "channels";
        EXPECT_FALSE(aov.meaning.empty());
        EXPECT_EQ((aov.value != nullptr) + (aov.id != nullptr) + aov.isCryptomatte(), 1);
        EXPECT_TRUE(aov.id == nullptr || channels.size() == 1);
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

std::vector<std::string> namesOf(const std::vector<Aov>& rows) {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const Aov& aov : rows) {
        names.push_back(aov.name());
    }
    return names;
}

TEST(Aov, isWrittenByItsIntegrators) {
    const std::vector<std::string> all = {"all"};
    const auto denoised = static_cast<std::size_t>(std::ranges::count(aovs(), AovUse::denoised, &Aov::use));
    EXPECT_EQ(chooseAovs(all, AovWriter::pathTracer).size() + denoised, aovs().size());
    for (const std::vector<Aov>& ofPrimary :
         {chooseAovs(all, AovWriter::everyIntegrator), usualAovs(AovWriter::everyIntegrator)}) {
        for (const Aov& aov : ofPrimary) {
            EXPECT_EQ(aov.writer, AovWriter::everyIntegrator) << aov.names;
            EXPECT_EQ(aov.filmParts, 0u) << aov.names;
        }
        const Image image = filmImage({}, {}, 0, 0, ofPrimary);
        EXPECT_TRUE(image.findChannel("N.X"));
        EXPECT_FALSE(image.findChannel("albedo.R"));
    }
}

TEST(Aov, hasANoisyTwinIfItIsDenoised) {
    const std::vector<std::string> direct = {"direct", "albedo"};
    EXPECT_EQ(namesOf(noisyAovs(chooseAovs(direct, AovWriter::pathTracer))),
              (std::vector<std::string>{"noisy", "noisy.direct"}));
    expectError(ErrorKind::invalidArgument, "'noisy' is no channel", {"aov"}, [] {
        const std::vector<std::string> noisy = {"noisy"};
        chooseAovs(noisy, AovWriter::pathTracer);
    });
}

// Blender reads LAYER.PASS.CHANNEL, where CHANNEL is one letter, what is before it may be missing, and the
// name has fewer than 64 characters; the letters of a pass are R G B (A), X Y (Z), U V or one alone
// (source/blender/imbuf/intern/openexr). Nuke reads LAYER.CHANNEL with letters, digits and underscores.
TEST(Aov, namesFollowTheRulesOfBlenderAndNuke) {
    const std::set<std::string> words = {"id.triangle", "id.mesh", "id.instance", "id.material",
                                         "samples",     "steps",   "tests"}; // which Blender leaves out
    std::map<std::string, std::string> lettersOfLayer;
    const auto add = [&](const std::string& channel) {
        EXPECT_TRUE(std::regex_match(channel, std::regex("([A-Za-z][A-Za-z0-9_]*\\.)*[A-Za-z]\\w*")))
            << channel;
        EXPECT_LT(channel.size(), 64u);
        const std::size_t dot = channel.rfind('.');
        const std::string letter = channel.substr(dot == std::string::npos ? 0 : dot + 1);
        EXPECT_EQ(letter.size() == 1, !words.contains(channel)) << channel;
        if (letter.size() == 1) {
            lettersOfLayer[dot == std::string::npos ? "" : channel.substr(0, dot)] += letter;
        }
    };
    for (const Aov& aov : aovs()) {
        if (!aov.isCryptomatte()) {
            std::ranges::for_each(aov.channels(), add);
        }
    }
    FilmData film(1, kFilmHits);
    Image mattes(1, 1, {});
    addCryptomatte({"CryptoObject", {}}, film, mattes);
    std::ranges::for_each(mattes.channels, add);
    for (const auto& [layer, letters] : lettersOfLayer) {
        const std::set<std::string> known = {"RGB", "RGBA", "XYZ", "XY", "UV"};
        EXPECT_TRUE(layer.empty() ? letters == "RGBAZt" : known.contains(letters))
            << layer << ": " << letters;
    }
    for (const char* const vector : {"N", "Ns", "P"}) {
        EXPECT_EQ(lettersOfLayer[vector], "XYZ");
    }
    EXPECT_EQ(lettersOfLayer["CryptoObject02"], "RGBA");
}

TEST(Aov, isChosenByName) {
    const auto choose = [](const std::vector<std::string>& names) {
        return chooseAovs(names, AovWriter::pathTracer);
    };
    EXPECT_EQ(namesOf(choose({"P", "id.mesh", "Z"})),
              (std::vector<std::string>{"", "A", "Z", "P", "id.mesh"})); // in the table's order
    EXPECT_EQ(filmPartsOf(choose({"Z"})), 0u);
    EXPECT_EQ(filmPartsOf(choose({"Z", "direct"})), kFilmLight);
    EXPECT_EQ(filmPartsOf(choose({"cryptomatte"})), kFilmHits);
    EXPECT_EQ(filmPartsOf(usualAovs(AovWriter::pathTracer)), 0u) << "what nobody asks for costs nothing";
    for (const char* const name : {"", "R", "albedo.R", "z", "all"}) {
        expectError(ErrorKind::invalidArgument, fmt::format("'{}' is no channel", name), [&] {
            choose({"Z", name});
        });
    }
    const std::vector<std::string> albedo = {"albedo"};
    expectError(ErrorKind::invalidArgument, "primary does not know the channel albedo",
                [&] { chooseAovs(albedo, AovWriter::everyIntegrator); });
}

TEST(Aov, isSmallOnlyWhere16BitsSuffice) {
    for (const char* const channel : {"R", "A", "N.X", "Ns.Z", "albedo.G", "direct.B", "emission.R"}) {
        EXPECT_TRUE(isSmall(channel)) << channel;
    }
    for (const char* const channel : {"Z", "t", "P.X", "UV.U", "variance.R", "steps", "other"}) {
        EXPECT_FALSE(isSmall(channel)) << channel;
    }
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
    EXPECT_EQ(idOf(image, "id.triangle"), 7u);
    EXPECT_EQ(idOf(image, "samples"), 3u);
    EXPECT_EQ(valueOf(image, "steps"), 10.0f);
    EXPECT_EQ(valueOf(image, "tests"), 2.0f);
}

TEST(Aov, isInfiniteOrNoIdForAMiss) {
    const Image image = imageOf(addSample(emptyPixel(), glm::vec3(1.0f), missFirst()));
    EXPECT_EQ(valueOf(image, "R"), 1.0f);
    EXPECT_EQ(valueOf(image, "A"), 0.0f);
    EXPECT_EQ(valueOf(image, "Z"), kInf);
    EXPECT_EQ(valueOf(image, "t"), kInf);
    for (const char* const channel : {"id.triangle", "id.mesh", "id.instance", "id.material"}) {
        EXPECT_EQ(idOf(image, channel), 4294967295u) << channel;
    }
    EXPECT_EQ(valueOf(image, "P.X"), 0.0f);
    EXPECT_EQ(valueOf(image, "UV.V"), 0.0f);
    EXPECT_EQ(valueOf(image, "variance.R"), 0.0f);
    const FilmPixel miss = addSample(emptyPixel(), glm::vec3(1.0f), missFirst());
    FilmData film(1, 0);
    film.pixels.front() = miss;
    const Image finite = filmImage(film, {}, 1, 1, aovs(), 1e10f);
    EXPECT_EQ(valueOf(finite, "Z"), 1e10f);
    EXPECT_EQ(valueOf(finite, "t"), 1e10f);
}

TEST(Aov, isWhatTheFirstSampleSees) {
    const FilmPixel pixel = addSample(emptyPixel(), glm::vec3(1.0f), hitAt(8.0f));
    const Image image =
        imageOf(pixel, noLight(), {{{1.0f, 2.0f, 3.0f}, {0.25f, 0.75f}, 4, 5, 16777217, {6.0f, -7.0f}}});
    EXPECT_EQ(valueOf(image, "P.Y"), 2.0f);
    EXPECT_EQ(valueOf(image, "motion.X"), 6.0f);
    EXPECT_EQ(valueOf(image, "motion.Y"), -7.0f);
    EXPECT_EQ(valueOf(image, "UV.U"), 0.25f);
    EXPECT_EQ(valueOf(image, "UV.V"), 0.75f);
    EXPECT_EQ(idOf(image, "id.mesh"), 4u);
    EXPECT_EQ(idOf(image, "id.instance"), 5u);
    EXPECT_EQ(idOf(image, "id.material"), 16777217u); // no float holds it
}

TEST(Aov, dividesLightByScatterings) {
    FilmPixel pixel = addSample(emptyPixel(), glm::vec3(1.0f), hitAt(1.0f));
    pixel = addSample(pixel, glm::vec3(3.0f), hitAt(1.0f));
    LightParts light = noLight();
    for (const std::uint32_t scatterings : {0u, 1u, 2u, 7u}) {
        light = addLight(light, scatterings, glm::vec3(0.5f, 1.0f, 2.0f));
    }
    const Image image = imageOf(pixel, light);
    EXPECT_EQ(valueOf(image, "emission.B"), 1.0f);
    EXPECT_EQ(valueOf(image, "direct.R"), 0.25f);
    EXPECT_EQ(valueOf(image, "indirect.G"), 1.0f);
}

// One of four samples meets an object, and three meet the shadow catcher.
TEST(Aov, laysShadowOverWhatIsBehindIt) {
    FilmPixel pixel = addSample(emptyPixel(), glm::vec3(8.0f), hitAt(1.0f));
    LightParts light = addLight(noLight(), 1u, glm::vec3(8.0f));
    for (int i = 0; i < 3; ++i) {
        pixel = addSample(pixel, glm::vec3(0.0f), missFirst());
        light = addParts(light, caughtLight({0.5f, 1.0f, 3.0f}, {1.0f, 2.0f, 2.0f}, glm::vec3(4.0f)));
    }
    const Image image = imageOf(pixel, light);
    EXPECT_EQ(valueOf(image, "shadow.R"), 0.5f);
    EXPECT_EQ(valueOf(image, "shadow.G"), 0.5f);
    EXPECT_EQ(valueOf(image, "shadow.B"), 1.5f);
    EXPECT_EQ(valueOf(image, "R"), 2.0f + 3.0f * 4.0f * 0.5f / 4.0f);
    EXPECT_EQ(valueOf(image, "emission.B"), 3.0f * 4.0f * 1.5f / 4.0f);
    const float left = 0.5f * (0.2126f + 0.7152f) + 1.5f * 0.0722f;
    EXPECT_NEAR(valueOf(image, "A"), (1.0f + 3.0f * (1.0f - left)) / 4.0f, 1e-6f);

    // A ground without light has no shadow. Over what is laid under it, a brighter one is as much brighter.
    EXPECT_EQ(valueOf(imageOf(pixel, caughtLight(glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f))), "A"),
              0.25f);
    FilmPixel ground = addSample(emptyPixel(), glm::vec3(0.0f), missFirst());
    EXPECT_NEAR(valueOf(imageOf(ground, caughtLight(glm::vec3(3.0f), glm::vec3(2.0f), glm::vec3(0.0f))), "A"),
                -0.5f, 1e-6f);
}

TEST(Aov, isANumberBeforeTheFirstSample) {
    const Image image = imageOf(emptyPixel());
    for (const float value : image.pixels) {
        EXPECT_FALSE(std::isnan(value));
    }
}

} // namespace
} // namespace metamarch
