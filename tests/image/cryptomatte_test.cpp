// SPDX-License-Identifier: MIT
#include "metamarch/image/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>

namespace metamarch {
namespace {

// Values of the reference implementation, with seed 0.
TEST(Cryptomatte, hashIsMurmurHash3) {
    EXPECT_EQ(murmurHash3(""), 0u);
    EXPECT_EQ(murmurHash3("test"), 0xba6bd213u);
    EXPECT_EQ(murmurHash3("hello"), 0x248bfa47u);
    EXPECT_EQ(murmurHash3("Hello, world!"), 0xc0363e43u);
    EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, idIsANormalNumber) {
    EXPECT_EQ(cryptomatteId("hello"), 0x248bfa47u);
    int changed = 0;
    for (int i = 0; i < 2000; ++i) {
        const std::string name = std::to_string(i);
        EXPECT_TRUE(std::isnormal(std::bit_cast<float>(cryptomatteId(name)))) << name;
        changed += cryptomatteId(name) != murmurHash3(name);
    }
    EXPECT_GT(changed, 0);
}

float valueOf(const Image& image, const std::string& channel) {
    return image.at(0, 0, image.findChannel(channel).value());
}

// Four groups, two of the same name. The pixel has 16 samples, of which 3 miss.
TEST(Cryptomatte, ranksCoverages) {
    FilmData film(1, kFilmHits);
    film.pixels.front().samples = 16;
    for (const std::uint32_t group : {3u, 0u, 1u, 0u, 2u, 0u, 1u, 3u, 0u, 2u, 3u, 3u, 3u}) {
        film.addHit(0, group);
    }
    Image image(1, 1, {"R"});
    addCryptomatte({"CryptoObject", {"box", "ball", "box", "lamp"}}, film, image);
    EXPECT_EQ(image.channels.size(), 1u + 2 * kCryptomatteRanks);
    const auto idOf = [&](const std::string& channel) {
        return std::bit_cast<std::uint32_t>(valueOf(image, channel));
    };
    EXPECT_EQ(idOf("CryptoObject00.R"), cryptomatteId("box")); // 4 + 2
    EXPECT_EQ(valueOf(image, "CryptoObject00.G"), 6.0f / 16.0f);
    EXPECT_EQ(idOf("CryptoObject00.B"), cryptomatteId("lamp"));
    EXPECT_EQ(valueOf(image, "CryptoObject00.A"), 5.0f / 16.0f);
    EXPECT_EQ(idOf("CryptoObject01.R"), cryptomatteId("ball"));
    EXPECT_EQ(valueOf(image, "CryptoObject01.G"), 2.0f / 16.0f);
    EXPECT_EQ(valueOf(image, "CryptoObject01.A"), 0.0f);
    EXPECT_EQ(valueOf(image, "CryptoObject02.B"), 0.0f);
}

TEST(Cryptomatte, headerHasTheManifest) {
    FilmData film(1, kFilmHits);
    Image image(1, 1, {"R"});
    addCryptomatte({"CryptoMaterial", {"a \"b\"", "test"}}, film, image);
    std::map<std::string, std::string> header;
    for (const auto& [name, value] : image.attributes) {
        header[name.substr(name.rfind('/') + 1)] = std::get<std::string>(value);
        EXPECT_EQ(name.substr(0, 12), "cryptomatte/");
        EXPECT_EQ(name.find('/', 12), 19u) << "seven digits";
    }
    EXPECT_EQ(header["name"], "CryptoMaterial");
    EXPECT_EQ(header["hash"], "MurmurHash3_32");
    EXPECT_EQ(header["conversion"], "uint32_to_float32");
    EXPECT_NE(header["manifest"].find(R"("a \"b\"":")"), std::string::npos);
    EXPECT_NE(header["manifest"].find(R"("test":"ba6bd213")"), std::string::npos);
}

// Readers hash the names of the manifest.
TEST(Cryptomatte, namesThatAreNoUtf8AreHashedAsTheManifestHasThem) {
    FilmData film(1, kFilmHits);
    film.pixels.front().samples = 1;
    film.addHit(0, 0);
    Image image(1, 1, {"R"});
    addCryptomatte({"CryptoObject", {"K\xf6rper"}}, film, image);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(valueOf(image, "CryptoObject00.R")),
              cryptomatteId("K\xef\xbf\xbdrper")); // U+FFFD in place of the byte
}

} // namespace
} // namespace metamarch
