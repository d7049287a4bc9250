// SPDX-License-Identifier: MIT
// What the window shows of a film while it gains samples: filtered at first, the film itself at last.
#include "fixtures/vulkan_environment.h"
#include "metamarch/scene/import.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shared/packed_pixel.h"
#include "metamarch/viewer/progressive_image.h"
#include "metamarch/vulkan/submission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace metamarch::viewer {
namespace {

constexpr glm::uvec2 kSize{60, 45};

class Progressive : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    static render::PreparedScene prepared() {
        const auto file = std::filesystem::path(METAMARCH_SOURCE_DIR) / "scenes" / "cornell.glb";
        render::PreparedScene made(std::make_shared<const Scene>(loadScene(file)), {});
        made.light("cornell.glb", {}, {});
        return made;
    }

    void start(const std::uint32_t samples) {
        RenderRequest request;
        request.camera = scene.scene().scene->cameras.front();
        request.settings = PathChoice{}.applied(scene.scene().shading->settings);
        request.endSample = samples;
        image.start(request, kSize);
    }

    // Shows the picture as a frame of the window does.
    void frame() {
        image.update();
        vulkan::Submission(vulkan::testDevice()).run([&](vulkan::Commands& commands) {
            image.record(commands);
        });
    }

    // Goes on until each pixel has so many samples, and further until their filtered picture is there.
    void advanceTo(const std::uint32_t samples) {
        while (image.wholeSamples() < samples || !image.isReady()) {
            ASSERT_TRUE(image.advance(0.05));
            frame();
        }
    }

    // Expects the filtered picture `before` to be dark in the next frame, and back in the one after it.
    void expectFollowsTones(const std::vector<std::uint32_t>& before) {
        image.setTone({.exposure = -30.0f});
        frame();
        EXPECT_EQ(image.shownPixels(), std::vector<std::uint32_t>(before.size(), 0xff000000u));
        image.setTone({});
        frame();
        EXPECT_EQ(image.shownPixels(), before);
    }

    std::vector<std::uint32_t> filmPixels(const ToneMapping& tone = {}) const {
        std::vector<std::uint32_t> pixels;
        for (const FilmPixel& pixel : image.film().pixels) {
            pixels.push_back(packedLinear(toneMapped(tone, meanRadiance(pixel))));
        }
        return pixels;
    }

    ShaderOverrides none;
    render::DeviceScene scene{vulkan::testDevice(), prepared()};
    ProgressiveImage image{vulkan::testDevice(), scene, std::string(traversals().front()), kSize, none};
};

TEST_F(Progressive, showsTheFilmItselfWithoutAFilter) {
    start(4);
    advanceTo(1);
    EXPECT_EQ(image.shownPixels(), filmPixels());
}

TEST_F(Progressive, filtersTheFirstSamplesOnly) {
    image.setFilter(true);
    start(64);
    advanceTo(1);
    const auto first = image.shownPixels();
    EXPECT_NE(first, filmPixels());
    advanceTo(8);
    EXPECT_NE(image.shownPixels(), first);
    EXPECT_NE(image.shownPixels(), filmPixels());
    advanceTo(render::DisplayFilter::kEnough);
    frame();
    EXPECT_EQ(image.shownPixels(), filmPixels());
}

// The last picture is that of `metamarch render`, however few samples it has.
TEST_F(Progressive, endsWithTheFilmItself) {
    image.setFilter(true);
    start(3);
    while (image.advance(0.05)) {
        frame();
    }
    frame();
    EXPECT_EQ(image.wholeSamples(), 3u);
    EXPECT_EQ(image.shownPixels(), filmPixels());
}

TEST_F(Progressive, filterIsSwitched) {
    image.setFilter(true);
    start(64);
    advanceTo(2);
    image.setFilter(false);
    frame();
    EXPECT_EQ(image.shownPixels(), filmPixels());
    image.setFilter(true);
    advanceTo(2);
    EXPECT_NE(image.shownPixels(), filmPixels());
    start(64); // another picture begins
    advanceTo(1);
    EXPECT_NE(image.shownPixels(), filmPixels());
}

TEST_F(Progressive, filteredPictureFollowsTheTones) {
    image.setFilter(true);
    start(64);
    advanceTo(1);
    expectFollowsTones(image.shownPixels());
}

// The tones do not wait for the next filtered picture, which is on its way.
TEST_F(Progressive, filteredPictureFollowsTheTonesAtOnce) {
    image.setFilter(true);
    start(64);
    advanceTo(1);
    const auto before = image.shownPixels();
    while (image.wholeSamples() < 2) {
        ASSERT_TRUE(image.advance(0.05));
        frame();
    }
    ASSERT_TRUE(image.advance(1e-9)); // begins to filter
    ASSERT_TRUE(image.advance(1e-9)); // a few rows
    frame();
    EXPECT_EQ(image.shownPixels(), before);
    expectFollowsTones(before);
    advanceTo(3); // behind the filtered picture of two samples
    EXPECT_NE(image.shownPixels(), before);
}

// A window of more pixels than a kernel can see of the filter's buffers (llvmpipe: 8.4 million).
TEST_F(Progressive, saysWhyALargePictureIsNotFiltered) {
    EXPECT_EQ(image.filterRefusal(), "");
    const std::uint64_t most = vulkan::testDevice().report().maxStorageBufferRange / sizeof(FilterLight);
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(most))) + 1;
    if (side > 40000) {
        GTEST_SKIP() << "the device binds all buffers";
    }
    ProgressiveImage large(vulkan::testDevice(), scene, std::string(traversals().front()), {side, side},
                           none);
    EXPECT_NE(large.filterRefusal(), "");
    ProgressiveImage fitting(vulkan::testDevice(), scene, std::string(traversals().front()),
                             {side - 1, side - 1}, none);
    EXPECT_EQ(fitting.filterRefusal(), "");
}

TEST_F(Progressive, filmIsNotFiltered) {
    start(64);
    advanceTo(1);
    const FilmData plain = image.film();
    image.setFilter(true);
    start(64);
    advanceTo(1);
    const FilmData beside = image.film();
    ASSERT_EQ(plain.pixels.size(), beside.pixels.size());
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
        ASSERT_EQ(plain.pixels[i].radiance, beside.pixels[i].radiance) << "pixel " << i;
    }
}

TEST_F(Progressive, channelsAreNotFiltered) {
    image.setChannel("albedo");
    start(64);
    advanceTo(1);
    const auto plain = image.shownPixels();
    image.setFilter(true);
    start(64);
    advanceTo(1);
    EXPECT_EQ(image.shownPixels(), plain);
}

} // namespace
} // namespace metamarch::viewer
