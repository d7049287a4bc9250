// Environment maps, sound and not.
#include "error.h"
#include "fixtures/expect_error.h"
#include "fixtures/shared_scenes.h"
#include "fixtures/temporary_folder.h"
#include "image/image_file.h"
#include "scene/environment.h"
#include "scene/gltf_file.h"
#include "scene/picture_file.h"

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
    expectError(ExitCode::sceneRefused, "an environment has channels R, G and B, or Y", [&] {
        loadEnvironment(writeExr({"depth", "id"}, {1, 2}, 1));
    });
}

TEST_F(EnvironmentTest, EncodedPicturesAreDecoded) {
    const Environment sky = loadEnvironment(write("sky.png", pngFile(1, 1, 3, {255, 0, 188})));
    EXPECT_EQ(sky.texels[0].r, 1.0f);
    EXPECT_EQ(sky.texels[0].g, 0.0f);
    EXPECT_NEAR(sky.texels[0].b, 0.5028864f, 1e-6f); // IEC 61966-2-1 of 188 / 255
}

TEST_F(EnvironmentTest, TexelsThatAreNoLight) {
    for (const float bad :
         {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
          -std::numeric_limits<float>::infinity()}) {
        std::vector<float> pixels(3 * 6, 1.0f);
        pixels[3 * 5 + 1] = bad;
        const std::filesystem::path file = writeExr({"R", "G", "B"}, pixels, 3);
        expectError(ExitCode::sceneRefused, file.string() + ": texel 2,1 has a radiance of ",
                    [&] { loadEnvironment(file); });
    }
}

TEST_F(EnvironmentTest, UnreadableOnesAreNamed) {
    expectError(ExitCode::sceneRefused, "gone.hdr", [&] { loadEnvironment(folder / "gone.hdr"); });
    expectError(ExitCode::sceneRefused, "prose.hdr",
                [&] { loadEnvironment(write("prose.hdr", "Dear friend,")); });
    expectError(ExitCode::sceneRefused, "empty.hdr",
                [&] { loadEnvironment(write("empty.hdr", hdrFile(0, 0, {}))); });
    const std::string whole = hdrFile(2, 2, std::vector<unsigned char>(16, 128));
    expectError(ExitCode::sceneRefused, "cut.hdr",
                [&] { loadEnvironment(write("cut.hdr", whole.substr(0, whole.size() - 1))); });
}

TEST(SharedScenes, Environments) {
    const auto folder = tests::sharedScenes();
    if (!folder)
        return;
    expectError(ExitCode::sceneRefused, "pmndrs-venice.exr: texel 59,102 has a radiance of -0.00993",
                [&] { loadEnvironment(*folder / "hdr/pmndrs-venice.exr"); });
    const Environment esplanade = loadEnvironment(*folder / "hdr/royal_esplanade_1k.hdr");
    EXPECT_EQ(esplanade.texels.size(), 1024u * 512u);
    const auto brightest = std::ranges::max(esplanade.texels, {}, [](const glm::vec3& t) { return t.g; });
    EXPECT_GT(brightest.g, 100.0f); // no 8-bit picture
}

} // namespace
} // namespace metamarch
