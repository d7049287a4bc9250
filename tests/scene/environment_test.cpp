// SPDX-License-Identifier: MIT
// Environment maps, valid and broken.
#include "fixtures/expect_error.h"
#include "fixtures/shared_scenes.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/error/error.h"
#include "metamarch/image/image_file.h"
#include "metamarch/shading/light/environment.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace metamarch {
namespace {

class EnvironmentTest : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& content) {
        writeFile(folder / name, content);
        return folder / name;
    }

    std::filesystem::path writeExr(const std::vector<std::string>& channels, const std::vector<float>& pixels,
                                   int width) {
        Image image(width, static_cast<int>(pixels.size() / channels.size()) / width, channels);
        image.pixels = pixels;
        writeImage(image, folder / "sky.exr");
        return folder / "sky.exr";
    }

    TemporaryFolder folder;
};

TEST_F(EnvironmentTest, RadianceHdr) {
    const Environment sky = loadEnvironment(write("sky.hdr", hdrFile(2, 1, {128, 64, 0, 130, 0, 0, 0, 0})));
    EXPECT_EQ(sky.width, 2u);
    EXPECT_EQ(sky.height, 1u);
    EXPECT_EQ(sky.texels, std::vector<glm::vec3>({{2, 1, 0}, {0, 0, 0}}));
}

TEST_F(EnvironmentTest, ExrByTheNamesOfItsChannels) {
    EXPECT_EQ(loadEnvironment(writeExr({"A", "B", "G", "R"}, {9, 3, 2, 1e30f}, 1)).texels,
              std::vector<glm::vec3>({{1e30f, 2, 3}}));
    EXPECT_EQ(loadEnvironment(writeExr({"Y"}, {4, 5}, 1)).texels,
              std::vector<glm::vec3>({{4, 4, 4}, {5, 5, 5}}));
    expectError(ErrorKind::inputRefused, "an environment has channels R, G and B, or Y", [&] {
        loadEnvironment(writeExr({"depth", "id"}, {1, 2}, 1));
    });
}

TEST_F(EnvironmentTest, EncodedPicturesAreDecoded) {
    const Environment sky = loadEnvironment(write("sky.png", pngFile(1, 1, 3, {255, 0, 188})));
    EXPECT_EQ(sky.texels[0].r, 1.0f);
    EXPECT_EQ(sky.texels[0].g, 0.0f);
    EXPECT_NEAR(sky.texels[0].b, 0.5028864f, 1e-6f); // IEC 61966-2-1 of 188 / 255
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Returns 9 x 5 texels of grey 1, except for one texel.
std::vector<float> greyBut(const glm::vec3& odd, std::size_t x, std::size_t y) {
    std::vector<float> pixels(std::size_t{3} * 9 * 5, 1.0f);
    float* const texel = &pixels[3 * (y * 9 + x)];
    texel[0] = odd.r;
    texel[1] = odd.g;
    texel[2] = odd.b;
    return pixels;
}

TEST_F(EnvironmentTest, TexelsThatAreNoLight) {
    for (const glm::vec3& bad :
         {glm::vec3(-1.0f), glm::vec3(0.5f, -1.0f, 0.5f), glm::vec3(-0.5f, -0.1f, -0.1f),
          glm::vec3(-1.0f, 0.9f, 0.0f), glm::vec3(1.0f, -0.3f, 0.0f), glm::vec3(1.0f, 1.0f, -kInfinity)}) {
        const std::filesystem::path file = writeExr({"R", "G", "B"}, greyBut(bad, 2, 1), 9);
        expectError(ErrorKind::inputRefused,
                    fmt::format("{}: texel 2,1 has a radiance of {} {} {}; light is ", file.string(), bad.r,
                                bad.g, bad.b),
                    [&] { loadEnvironment(file); });
    }
    for (const glm::vec3& everywhere : {glm::vec3(-1.0f), glm::vec3(0.5f, -1.0f, 0.5f), glm::vec3(-1e-30f)}) {
        std::vector<float> pixels;
        for (int i = 0; i < 8; ++i) {
            pixels.insert(pixels.end(), {everywhere.r, everywhere.g, everywhere.b});
        }
        const std::filesystem::path file = writeExr({"R", "G", "B"}, pixels, 4);
        expectError(ErrorKind::inputRefused, ": texel 0,0 has a radiance of ",
                    [&] { loadEnvironment(file); });
    }
}

// Half floats end at 65504, so a sun above that is infinite in them.
TEST_F(EnvironmentTest, InfiniteLightIsTakenForTheLargestHalf) {
    std::vector<float> pixels = greyBut({kInfinity, kInfinity, 5.0f}, 2, 1);
    pixels[0] = kInfinity;
    const std::filesystem::path file = writeExr({"R", "G", "B"}, pixels, 9);
    const Environment sky = loadEnvironment(file);
    EXPECT_EQ(sky.texels[11], glm::vec3(65504, 65504, 5));
    EXPECT_EQ(sky.texels[0], glm::vec3(65504, 1, 1));
    EXPECT_EQ(sky.texels[1], glm::vec3(1));
    EXPECT_EQ(sky.warnings,
              std::vector<std::string>(
                  {file.string() + ": infinite light is taken for 65504; texels that have it: 2; a maximum "
                                   "for the map's light dims them"}));
    // In a map with finite light above that, infinite light is not darker.
    pixels[3] = 1e6f;
    EXPECT_EQ(loadEnvironment(writeExr({"R", "G", "B"}, pixels, 9)).texels[11], glm::vec3(1e6f, 1e6f, 5));
}

TEST_F(EnvironmentTest, LightThatIsNoNumberIsTakenForNone) {
    const std::filesystem::path file = writeExr({"R", "G", "B"}, greyBut({kNan, 2.0f, kNan}, 2, 1), 9);
    const Environment sky = loadEnvironment(file);
    EXPECT_EQ(sky.texels[11], glm::vec3(0, 2, 0));
    EXPECT_EQ(sky.warnings,
              std::vector<std::string>(
                  {file.string() + ": light that is no number is taken for 0; texels that have it: 1"}));
}

TEST_F(EnvironmentTest, MaximumKeepsColours) {
    std::vector<float> pixels = greyBut({100.0f, 50.0f, 25.0f}, 2, 1);
    pixels[0] = kInfinity;
    const std::filesystem::path file = writeExr({"R", "G", "B"}, pixels, 9);
    const Environment sky = loadEnvironment(file, 10.0f);
    EXPECT_EQ(sky.texels[11], glm::vec3(10, 5, 2.5f));
    EXPECT_EQ(sky.texels[0], glm::vec3(10, 1, 1));
    EXPECT_EQ(sky.texels[1], glm::vec3(1));
    EXPECT_EQ(sky.warnings,
              std::vector<std::string>(
                  {file.string() + ": infinite light is taken for 10; texels that have it: 1"}));
}

TEST_F(EnvironmentTest, ColoursOutsideRec709LoseTheirNegativeChannel) {
    // Rec. 2020's green, and monochromatic light of 490 nm, in Rec. 709.
    for (const glm::vec3& color : {glm::vec3(-0.588f, 1.133f, -0.101f), glm::vec3(-0.448f, 0.379f, 0.451f)}) {
        const std::filesystem::path file = writeExr({"R", "G", "B"}, greyBut(color, 4, 2), 9);
        const Environment sky = loadEnvironment(file);
        EXPECT_EQ(sky.texels[2 * 9 + 4], glm::max(color, 0.0f));
        EXPECT_EQ(sky.warnings, std::vector<std::string>({file.string() +
                                                          ": channels below 0 are taken for 0; texels that "
                                                          "have them: 1 (1 colours outside Rec. 709, 0 "
                                                          "undershoots of a filter beside brighter light)"}));
    }
    EXPECT_TRUE(loadEnvironment(writeExr({"R", "G", "B"}, greyBut({1, 0, 1}, 4, 2), 9)).warnings.empty());
}

TEST_F(EnvironmentTest, UndershootBesideBrighterLightBecomesBlack) {
    // A point of light between two texels, scaled by Lanczos's filter with three lobes, across the seam.
    const std::vector<float> lobes = {0.0243f, -0.1351f, 0.6079f, 0.6079f, -0.1351f, 0.0243f};
    const std::size_t width = 16;
    std::vector<float> pixels(width * 3, 0.0f);
    for (std::size_t y = 0; y < 3; ++y) {
        for (std::size_t i = 0; i < lobes.size(); ++i) {
            pixels[y * width + (i + 14) % width] = (y == 1 ? 1.0f : -0.2f) * lobes[i];
        }
    }
    const Environment sky = loadEnvironment(writeExr({"Y"}, pixels, width));
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        EXPECT_EQ(sky.texels[i], glm::vec3(std::max(pixels[i], 0.0f))) << i;
    }
    EXPECT_EQ(sky.warnings.size(), 1u);
    // Far from the light, the same negative value is no undershoot.
    pixels[width + 8] = -0.1351f;
    expectError(ErrorKind::inputRefused, ": texel 8,1 has a radiance of -0.1351",
                [&] { loadEnvironment(writeExr({"Y"}, pixels, width)); });
}

TEST_F(EnvironmentTest, UnreadableOnesAreNamed) {
    expectError(ErrorKind::inputRefused, "gone.hdr", [&] { loadEnvironment(folder / "gone.hdr"); });
    expectError(ErrorKind::inputRefused, "prose.hdr",
                [&] { loadEnvironment(write("prose.hdr", "Dear friend,")); });
    expectError(ErrorKind::inputRefused, "empty.hdr",
                [&] { loadEnvironment(write("empty.hdr", hdrFile(0, 0, {}))); });
    const std::string whole = hdrFile(2, 2, std::vector<unsigned char>(16, 128));
    expectError(ErrorKind::inputRefused, "cut.hdr",
                [&] { loadEnvironment(write("cut.hdr", whole.substr(0, whole.size() - 1))); });
}

TEST(SharedScenes, Environments) {
    const Environment venice =
        // Was scaled with a filter that undershoots deeply.
        loadEnvironment(tests::sharedScene("hdr/pmndrs-venice.exr"));
    ASSERT_EQ(venice.warnings.size(), 1u);
    EXPECT_NE(
        venice.warnings[0].find("texels that have them: 233 (91 colours outside Rec. 709, 142 undershoots"),
        std::string::npos)
        << venice.warnings[0];
    EXPECT_GE(std::ranges::min(venice.texels, {}, [](const glm::vec3& t) { return t.b; }).b, 0.0f);
    const Environment esplanade = loadEnvironment(tests::sharedScene("hdr/royal_esplanade_1k.hdr"));
    EXPECT_EQ(esplanade.texels.size(), 1024u * 512u);
    const auto brightest = std::ranges::max(esplanade.texels, {}, [](const glm::vec3& t) { return t.g; });
    EXPECT_GT(brightest.g, 100.0f); // not an 8-bit image
}

} // namespace
} // namespace metamarch
