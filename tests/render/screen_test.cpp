// SPDX-License-Identifier: MIT
// The pictures of a window: films that grow in small pieces, their conversion to bytes, and the composition
// of pictures. Compares the device bit by bit with the same functions on the CPU.
#include "fixtures/vulkan_environment.h"
#include "metamarch/image/tone_mapping.h"
#include "metamarch/render/kernel.h"
#include "metamarch/render/path_sampler.h"
#include "metamarch/render/path_tracer.h"
#include "metamarch/render/resolver.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/shading.h"
#include "metamarch/shared/backdrop.h"
#include "metamarch/shared/inspect_view.h"
#include "metamarch/shared/packed_pixel.h"
#include "metamarch/shared/primary.h"
#include "metamarch/shared/screen.h"
#include "metamarch/vulkan/transfer.h"
#include "path/path_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace metamarch::tests {
namespace {

const std::string kDefaultTraversal(traversals().front());

// A lamp over a floor with a ball between them. The size of the picture is not a multiple of a tile's.
class GrowingFilm : public testing::Test {
  protected:
    static constexpr std::uint32_t kWidth = 51;
    static constexpr std::uint32_t kHeight = 38;

    GrowingFilm()
        : made(room()), structure(buildAccelerationStructure(made.scene, {})), shading(shadingOf(made)),
          primary(makeShadingData(made.scene)), buffers(vulkan::testDevice(), structure, primary),
          shadingBuffers(vulkan::testDevice(), shading), settings(settingsOf(shading, {})),
          camera(makeCamera(made.view, kWidth, kHeight, made.camera)) {}

    static PathScene room() {
        PathScene scene;
        addQuad(scene.scene, {-2.0f, 0.0f, 2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -4.0f},
                addMaterial(scene.scene, lambert({0.7f, 0.6f, 0.5f})));
        addBall(scene.scene, {0.0f, 0.6f, 0.0f}, 0.6f,
                addMaterial(scene.scene, metal({0.9f, 0.7f, 0.3f}, 0.3f)));
        addPointLight(scene.scene, {1.5f, 3.0f, 1.0f}, 20.0f);
        scene.surroundings.background = glm::vec3(0.2f);
        scene.view = lookAt({0.5f, 1.5f, 4.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 1.0f, 0.0f});
        return scene;
    }

    std::vector<FilmPixel> atOnce(const Camera& seen, const std::uint32_t samples) const {
        render::DevicePathSampler sampler(vulkan::testDevice(), buffers, shadingBuffers, kDefaultTraversal,
                                          {settings, seen, {0, 0, seen.width, seen.height}});
        return takeSamples(sampler, samples).pixels;
    }

    render::PathTracer tracer(const std::uint32_t mostTilesOfBand = render::DeviceFilm::kAllTiles) const {
        return {vulkan::testDevice(),
                buffers,
                shadingBuffers,
                kDefaultTraversal,
                camera,
                render::Tiling(camera).count,
                0,
                {},
                render::PathTracer::kFirstTurns,
                mostTilesOfBand};
    }

    std::vector<FilmPixel> filmOf(const render::PathTracer& from) const {
        FilmData film(std::size_t{from.camera().width} * from.camera().height, 0);
        from.download(film);
        return film.pixels;
    }

    static void expectSame(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b) {
        ASSERT_EQ(a.size(), b.size());
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(FilmPixel)), 0);
    }

    PathScene made;
    AccelerationStructure structure;
    ShadingScene shading;
    ShadingData primary;
    render::SceneBuffers buffers;
    render::ShadingBuffers shadingBuffers;
    PathSettings settings;
    Camera camera;
};

// A time in seconds that is shorter than any submission, so that each one takes one sample of one tile.
constexpr double kSmallest = 1e-9;

TEST_F(GrowingFilm, isTheSameInAnyPieces) {
    constexpr std::uint32_t kSamples = 2 * kBlockSamples + 3; // three blocks
    render::PathTracer small = tracer();
    small.start(camera, settings, {0, render::Tiling(camera).count});
    while (small.samples() < kSamples) {
        small.advance(kSamples, 2, kSmallest);
    }
    EXPECT_EQ(small.samples(), kSamples);
    expectSame(filmOf(small), atOnce(camera, kSamples));
}

// A film that is larger than a buffer may be lies in several bands, the last of which is smaller.
TEST_F(GrowingFilm, isTheSameInBands) {
    constexpr std::uint32_t kSamples = kBlockSamples + 3; // two blocks
    const std::vector<FilmPixel> expected = atOnce(camera, kSamples);
    const std::uint32_t tiles = render::Tiling(camera).count;
    for (const std::uint32_t ofBand : {1u, 8u, tiles - 1}) {
        render::PathTracer banded = tracer(ofBand);
        ASSERT_EQ(banded.film().bands().size(), (tiles + ofBand - 1) / ofBand);
        banded.start(camera, settings, {0, tiles});
        while (banded.samples() < kSamples) {
            banded.advance(kSamples, 5, render::WorkSize::kTargetSeconds);
        }
        expectSame(filmOf(banded), expected);
        for (const glm::uvec2 place : {glm::uvec2(0, 0), glm::uvec2(kWidth - 1, 3), glm::uvec2(9, 20)}) {
            expectSame({banded.pixel(place.x, place.y)}, {expected[place.y * kWidth + place.x]});
        }
        const render::Resolver resolver(vulkan::testDevice(), banded, kWidth * kHeight);
        vulkan::Submission(vulkan::testDevice()).run([&](vulkan::Commands& commands) {
            resolver.resolve(commands, {1, tiles - 1}, {kWidth, kHeight}, {});
            resolver.resolve(commands, {0, 1}, {kWidth, kHeight}, {});
            resolver.resolve(commands, {tiles - 1, tiles}, {kWidth, kHeight}, {});
        });
        const auto shown = vulkan::download<std::uint32_t>(vulkan::testDevice(), resolver.picture());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const std::uint32_t own = packedLinear(toneMapped({}, meanRadiance(expected[i])));
            ASSERT_EQ(shown[i], withCoverage(own, coverage(expected[i]))) << "pixel " << i;
        }
    }
}

// Sums go to bands and come back from them.
TEST_F(GrowingFilm, goesOnInBands) {
    constexpr std::uint32_t kBefore = kBlockSamples + 2;
    constexpr std::uint32_t kSamples = kBlockSamples + 9;
    const std::uint32_t tiles = render::Tiling(camera).count;
    render::PathTracer first = tracer(9);
    first.start(camera, settings, {0, tiles});
    while (first.samples() < kBefore) {
        first.advance(kBefore, kBlockSamples, render::WorkSize::kTargetSeconds);
    }
    FilmData earlier(std::size_t{kWidth} * kHeight, 0);
    FilmData block = earlier;
    const std::uint32_t blockFirst = first.downloadSums(earlier, block);
    render::PathTracer second = tracer(4);
    second.start(camera, settings, {0, 0, kWidth, kHeight}, {0, tiles}, blockFirst);
    second.upload(earlier, block);
    while (second.samples() < kSamples) {
        second.advance(kSamples, kBlockSamples, render::WorkSize::kTargetSeconds);
    }
    expectSame(filmOf(second), atOnce(camera, kSamples));
}

// The kernel is compiled for what the camera has: a lens, a panorama, a wide filter.
TEST_F(GrowingFilm, followsCamerasWithOtherFeatures) {
    const CameraOptions plain = made.camera;
    CameraOptions lens = plain;
    lens.apertureRadius = 0.3f;
    CameraOptions panorama = plain;
    panorama.isPanorama = true;
    CameraOptions filtered = plain;
    filtered.pixelFilter = kFilterTent;
    render::PathTracer one = tracer();
    for (const CameraOptions& options : {plain, lens, panorama, filtered, plain}) {
        const Camera seen = makeCamera(made.view, kWidth, kHeight, options);
        one.start(seen, settings, {0, render::Tiling(seen).count});
        while (one.samples() < 2) {
            one.advance(2, 2, render::WorkSize::kTargetSeconds);
        }
        expectSame(filmOf(one), atOnce(seen, 2));
    }
}

TEST_F(GrowingFilm, givesSinglePixels) {
    constexpr std::uint32_t kSamples = kBlockSamples + 2; // two blocks
    render::PathTracer whole = tracer();
    whole.start(camera, settings, {0, render::Tiling(camera).count});
    EXPECT_EQ(whole.pixel(0, 0).samples, 0u);
    while (whole.samples() < kSamples) {
        whole.advance(kSamples, kSamples, render::WorkSize::kTargetSeconds);
    }
    std::vector<FilmPixel> pixels;
    for (std::uint32_t y = 0; y < camera.height; ++y) {
        for (std::uint32_t x = 0; x < camera.width; ++x) {
            pixels.push_back(whole.pixel(x, y));
        }
    }
    expectSame(pixels, filmOf(whole));
    EXPECT_EQ(whole.pixel(camera.width, 0).samples, 0u);
}

// Few surfaces of an invocation in one dispatch: paths are cut, taken again, and get more turns.
TEST_F(GrowingFilm, isTheSameInManyTurns) {
    for (const std::uint32_t turns : {1u, 3u, 20u}) {
        render::PathTracer cut(vulkan::testDevice(), buffers, shadingBuffers, kDefaultTraversal, camera,
                               render::Tiling(camera).count, 0, {}, turns);
        cut.start(camera, settings, {0, render::Tiling(camera).count});
        while (cut.samples() < kBlockSamples + 2) {
            cut.advance(kBlockSamples + 2, kBlockSamples, render::WorkSize::kTargetSeconds);
        }
        expectSame(filmOf(cut), atOnce(camera, kBlockSamples + 2));
    }
}

// The sums are read while a tile has some of the samples of its pass, in the first block and in a later one.
TEST_F(GrowingFilm, goesOnFromSumsOfAPartOfATile) {
    constexpr std::uint32_t kSamples = kBlockSamples + 9;
    const std::size_t pixels = std::size_t{camera.width} * camera.height;
    for (const std::uint32_t begun : {0u, kBlockSamples}) {
        for (const int further : {1, 2, 5}) {
            render::PathTracer first = tracer();
            first.start(camera, settings, {0, render::Tiling(camera).count});
            while (first.samples() < begun) {
                first.advance(begun, kBlockSamples, render::WorkSize::kTargetSeconds);
            }
            for (int i = 0; i < further; ++i) {
                first.advance(kSamples, kBlockSamples, kSmallest);
            }
            FilmData earlier(pixels, 0);
            FilmData block(pixels, 0);
            const std::uint32_t blockFirst = first.downloadSums(earlier, block);
            EXPECT_TRUE(
                std::ranges::any_of(block.pixels, [](const FilmPixel& pixel) { return pixel.samples > 0; }));
            render::PathTracer second = tracer();
            second.start(camera, settings, {0, 0, camera.width, camera.height},
                         {0, render::Tiling(camera).count}, blockFirst);
            second.upload(earlier, block);
            while (second.samples() < kSamples) {
                second.advance(kSamples, kBlockSamples, kSmallest);
            }
            expectSame(filmOf(second), atOnce(camera, kSamples));
        }
    }
}

TEST_F(GrowingFilm, leavesNoPixelFarBehind) {
    render::PathTracer small = tracer();
    small.start(camera, settings, {0, render::Tiling(camera).count});
    for (int i = 0; i < 50; ++i) {
        const double before = small.meanSamples();
        const render::TileRange changed = small.advance(100, 1, kSmallest);
        EXPECT_GT(changed.count(), 0u);
        EXPECT_GE(small.meanSamples(), before);
        for (const FilmPixel& pixel : filmOf(small)) {
            ASSERT_GE(pixel.samples, small.samples());
            ASSERT_LE(pixel.samples, small.samples() + 1);
        }
    }
}

TEST_F(GrowingFilm, beginsAnewWithAnotherCamera) {
    render::PathTracer one = tracer();
    one.start(camera, settings, {0, render::Tiling(camera).count});
    one.advance(3, 1, kSmallest); // does not finish the film
    one.advance(3, 1, kSmallest);
    const SceneCamera above = lookAt({0.0f, 4.0f, 0.5f}, {0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    const Camera smaller = makeCamera(above, kWidth / 3, kHeight / 3, {});
    one.start(smaller, settings, {0, render::Tiling(smaller).count});
    EXPECT_EQ(one.samples(), 0u);
    EXPECT_EQ(one.meanSamples(), 0.0);
    while (one.samples() < 3) {
        one.advance(3, kBlockSamples, render::WorkSize::kTargetSeconds);
    }
    expectSame(filmOf(one), atOnce(smaller, 3));
}

TEST_F(GrowingFilm, countsItsWork) {
    render::PathTracer one = tracer();
    one.start(camera, settings, {0, render::Tiling(camera).count});
    while (one.samples() < 5) {
        one.advance(5, 2, kSmallest);
    }
    double rays = 0.0;
    double steps = 0.0;
    double tests = 0.0;
    for (const FilmPixel& pixel : filmOf(one)) {
        rays += pixel.rays + pixel.shadowRays;
        steps += pixel.steps;
        tests += pixel.tests;
    }
    EXPECT_EQ(one.counters().rays, rays);
    EXPECT_EQ(one.counters().steps, steps);
    EXPECT_EQ(one.counters().tests, tests);
    EXPECT_EQ(one.counters().samples, 5.0 * render::Tiling(camera).count * kTilePixels);
}

TEST_F(GrowingFilm, becomesTheBytesOfAPng) {
    render::PathTracer one = tracer();
    one.start(camera, settings, {0, render::Tiling(camera).count});
    one.advance(1, 1, kSmallest); // most pixels still have no samples
    const render::Resolver resolver(vulkan::testDevice(), one, kWidth * kHeight);
    for (int samples = 1; samples < 4; ++samples) {
        const std::vector<FilmPixel> film = filmOf(one);
        for (const ToneOperatorName& known : kToneOperators) {
            const ToneMapping tone{known.toneOperator, 0.5f * static_cast<float>(samples)};
            vulkan::Submission(vulkan::testDevice()).run([&](vulkan::Commands& commands) {
                commands.fill(resolver.picture(), 0);
                resolver.resolve(commands, one.begunTiles(), {kWidth, kHeight}, tone);
            });
            const auto shown = vulkan::download<std::uint32_t>(vulkan::testDevice(), resolver.picture());
            for (std::size_t i = 0; i < film.size(); ++i) {
                const std::uint32_t expected =
                    film[i].samples == 0 ? 0u
                                         : withCoverage(packedLinear(toneMapped(tone, meanRadiance(film[i]))),
                                                        coverage(film[i]));
                ASSERT_EQ(shown[i], expected) << known.name << ", pixel " << i;
            }
        }
        while (one.samples() < static_cast<std::uint32_t>(samples)) {
            one.advance(100, 1, render::WorkSize::kTargetSeconds);
        }
    }
}

vec3 backdropAt(const std::vector<glm::vec4>& texels, const PresentPush& push, const std::uint32_t x,
                const std::uint32_t y) {
    const BackdropPlace place =
        backdropPlace(x, y, push.width, push.height, push.backdropColumns, push.backdropRows);
    return backdropBetween(vec3(texels[place.upperLeft]), vec3(texels[place.upperRight]),
                           vec3(texels[place.lowerLeft]), vec3(texels[place.lowerRight]), place);
}

class Presented : public testing::TestWithParam<PresentPush> {};

TEST_P(Presented, pixelsAreOfTheFinePictureWhereItIsThere) {
    const PresentPush push = GetParam();
    std::mt19937 random(11);
    const auto picture = [&](const std::uint32_t width, const std::uint32_t height, const bool hasHoles) {
        std::vector<std::uint32_t> pixels(std::size_t{width} * height);
        for (std::uint32_t& pixel : pixels) {
            const auto color = static_cast<std::uint32_t>(random());
            const bool isPart = random() % 2 == 0;
            pixel = hasHoles && random() % 3 == 0 ? 0u : isPart ? color | 0x01000000u : color | 0xff000000u;
        }
        return pixels;
    };
    const auto fine = picture(push.fineWidth, push.fineHeight, true);
    const auto coarse = picture(push.coarseWidth, push.coarseHeight, false);
    constexpr std::uint32_t kBefore = 0x12345678u;
    const std::vector<std::uint32_t> before(std::size_t{push.width} * push.height, kBefore);

    const vulkan::Device& device = vulkan::testDevice();
    const vulkan::Buffer fineBuffer = vulkan::upload(device, std::span(fine), "fine");
    const vulkan::Buffer coarseBuffer = vulkan::upload(device, std::span(coarse), "coarse");
    const vulkan::Buffer screen = vulkan::upload(device, std::span(before), "screen");
    vulkan::ComputePipeline kernel =
        render::makeKernel(device, "present",
                           {.storageBindings = {kBindInput, kBindCoarse, kBindBackdrop, kBindOutput},
                            .pushConstantSize = sizeof(PresentPush),
                            .specialization = {{kSpecBackdrop, push.backdropColumns != 0u ? 1u : 0u}}});
    std::vector<glm::vec4> backdrop(std::max(push.backdropColumns * push.backdropRows, 1u));
    for (glm::vec4& texel : backdrop) {
        texel = glm::vec4(random() % 256, random() % 256, random() % 256, 0) / 255.0f;
    }
    const vulkan::Buffer backdropBuffer = vulkan::upload(device, std::span(backdrop), "backdrop");
    kernel.bind(kBindBackdrop, backdropBuffer);
    kernel.bind(kBindInput, fineBuffer);
    kernel.bind(kBindCoarse, coarseBuffer);
    kernel.bind(kBindOutput, screen);
    const std::uint32_t columns = push.endColumn - push.firstColumn;
    vulkan::Submission(device).run([&](vulkan::Commands& commands) {
        commands.dispatch(kernel, {(columns + kScreenTile - 1) / kScreenTile, push.height, 1}, push);
    });

    const auto shown = vulkan::download<std::uint32_t>(device, screen);
    for (std::uint32_t y = 0; y < push.height; ++y) {
        for (std::uint32_t x = 0; x < push.width; ++x) {
            const std::uint32_t over =
                fine[y * push.fineHeight / push.height * push.fineWidth + x * push.fineWidth / push.width];
            const std::uint32_t under = coarse[y * push.coarseHeight / push.height * push.coarseWidth +
                                               x * push.coarseWidth / push.width];
            const std::uint32_t top = over == 0u ? under : over;
            const std::uint32_t seen =
                0xff000000u |
                (push.backdropColumns == 0u ? top : overBackdrop(top, backdropAt(backdrop, push, x, y)));
            const std::uint32_t ordered =
                push.isBlueFirst == 0u
                    ? seen
                    : (seen & 0xff00ff00u) | ((seen & 0xffu) << 16u) | ((seen >> 16u) & 0xffu);
            const bool isWritten = x >= push.firstColumn && x < push.endColumn;
            ASSERT_EQ(shown[y * push.width + x], isWritten ? ordered : kBefore) << x << ", " << y;
        }
    }
}

// The cases are the whole window at its own size, parts of it as in a split view, and a film that is smaller
// than the window. With a backdrop of one texel, and of several.
INSTANTIATE_TEST_SUITE_P(Screen, Presented,
                         testing::Values(PresentPush{130, 21, 0, 130, 130, 21, 65, 11, 0, 0, 0},
                                         PresentPush{130, 21, 0, 57, 130, 21, 9, 2, 1, 0, 0},
                                         PresentPush{130, 21, 57, 130, 130, 21, 9, 2, 1, 0, 0},
                                         PresentPush{101, 67, 0, 101, 51, 34, 7, 5, 1, 0, 0},
                                         PresentPush{130, 21, 0, 130, 130, 21, 65, 11, 0, 1, 1},
                                         PresentPush{130, 21, 57, 130, 130, 21, 9, 2, 1, 9, 5}));

TEST(Backdrop, isSeenWhereNothingCoversAPixel) {
    const vec3 blue(0.1f, 0.2f, 0.7f);
    const std::uint32_t own = packedLinear({0.5f, 0.25f, 0.0f});
    EXPECT_EQ(overBackdrop(withCoverage(own, 1.0f), blue), own);
    EXPECT_EQ(overBackdrop(withCoverage(own, 0.0f), blue), packedLinear(blue));
    EXPECT_EQ(overBackdrop(0u, blue), packedLinear(blue)); // nothing is known yet
    EXPECT_EQ(overBackdrop(kMissColor, blue), packedLinear(blue));
    const std::uint32_t half = overBackdrop(withCoverage(own, 0.5f), blue);
    EXPECT_EQ(half, packedLinear(vec3(0.5f, 0.25f, 0.0f) + 0.5f * blue));
    EXPECT_EQ(withCoverage(own, -3.0f) >> 24u, 1u);
    EXPECT_EQ(withCoverage(own, 3.0f) >> 24u, 255u);
}

TEST(Backdrop, invertsTheCurveOfAScreen) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        const std::uint32_t grey = byte * 0x010101u | 0xff000000u;
        EXPECT_EQ(packedLinear(linearOf(grey)), grey);
    }
}

TEST(Backdrop, liesBetweenItsTexels) {
    const BackdropPlace first =
        backdropPlace(0, 0, 100, 50, 4, 2); // nearer to the edge than a texel's centre
    EXPECT_EQ(first.upperLeft, 0u);
    EXPECT_EQ(first.right, 0.0f);
    EXPECT_EQ(first.down, 0.0f);
    const BackdropPlace last = backdropPlace(99, 49, 100, 50, 4, 2);
    EXPECT_EQ(last.upperLeft, 7u);
    EXPECT_EQ(last.lowerRight, 7u);
    const BackdropPlace middle = backdropPlace(49, 24, 99, 49, 4, 2); // the window's middle
    EXPECT_EQ(middle.upperLeft, 1u);
    EXPECT_EQ(middle.lowerRight, 6u);
    EXPECT_FLOAT_EQ(middle.right, 0.5f);
    EXPECT_FLOAT_EQ(middle.down, 0.5f);
}

} // namespace
} // namespace metamarch::tests
