// SPDX-License-Identifier: MIT
// The path tracers of device and CPU make the same film bit by bit, except for steps and tests, which depend
// on the traversal.
#include "fixtures/shared_scenes.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/light/sky.h"
#include "path/both_sides.h"
#include "path/gpu_scenes.h"

#include <gtest/gtest.h>

#include <iostream>
#include <map>

namespace metamarch::tests {
namespace {

class PathGpu : public testing::TestWithParam<GpuPathScene> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }
};

TEST_P(PathGpu, drawsWhatTheCpuDraws) {
    if (GetParam().name == "everything" && vulkan::testDevice().report().driver.starts_with("SwiftShader")) {
        GTEST_SKIP()
            << "its compiler ends the process: the kernel with every feature has more local variables "
               "than a stack frame takes";
    }
    const PathWork work = GetParam().work;
    const BothSides sides(GetParam().make(), {work.side + 12, work.side + 4});
    const FilmData expected = sides.filmByJudge(work);
    expectPicture(expected.pixels);
    const FilmData film = sides.onDevice(kDefaultTraversal, work).film;
    expectSameFilm(film.pixels, expected.pixels);
    expectSameLight(film.light, expected.light);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathGpu, testing::ValuesIn(gpuPathScenes()),
                         [](const auto& instance) { return instance.param.name; });

// What a device that rounds otherwise may draw: the last bits of every pixel differ. A picture that is a
// little too bright, or wrong in some pixels, is another.
TEST(SamePicture, holdsOtherLastBitsAlone) {
    const std::vector<FilmPixel> film =
        BothSides(gpuPathScenes().front().make(), {28, 20}).onCpu({.samples = 16});
    const auto changed = [&](const float factor, const std::size_t step) {
        std::vector<FilmPixel> other = film;
        for (std::size_t i = 0; i < other.size(); i += step) {
            other[i].radiance *= factor;
            other[i].squares *= factor * factor;
        }
        return other;
    };
    EXPECT_TRUE(isSamePicture(film, changed(1.00001f, 1)));
    EXPECT_FALSE(isSamePicture(film, changed(1.02f, 1)));
    EXPECT_FALSE(isSamePicture(film, changed(3.0f, 10)));
    EXPECT_FALSE(isSamePicture(film, {film.begin(), film.end() - 1}));
}

class PathGpuWork : public testing::Test {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }

    const PathWork work{.samples = 5};
};

TEST_F(PathGpuWork, anyTraversalDrawsTheSame) {
    const BothSides sides(blended(), {28, 20});
    const auto expected = sides.onCpu(work);
    expectPicture(expected);
    int drawn = 0;
    for (const std::string_view traversal : traversals()) {
        const auto missing = render::missingFor(vulkan::testDevice().report(), traversal);
        if (!missing.empty()) {
            std::cerr << vulkan::testDevice().name() << " cannot run " << traversal << "\n";
            continue;
        }
        SCOPED_TRACE(traversal);
        const auto render =
            vulkan::ifTexelsSuffice([&] { return sides.onDevice(std::string(traversal), work); });
        if (render) {
            ++drawn;
            expectSameFilm(render->film.pixels, expected);
        }
    }
    if (drawn == 0) {
        GTEST_SKIP() << vulkan::testDevice().name() << " has too few texels for every traversal";
    }
}

// This scene has only some features, because llvmpipe takes half a minute to compile all of them with storage
// buffers.
TEST_F(PathGpuWork, storageBuffersDrawTheSame) {
    // The kernel of the default traversal has fewer than kMostStorageBuffers; lavapipe's limit suffices.
    constexpr std::uint32_t kSufficient = 32;
    if (vulkan::testDevice().report().maxPerStageDescriptorStorageBuffers < kSufficient) {
        GTEST_SKIP() << vulkan::testDevice().name() << " has too few storage buffers";
    }
    const BothSides sides(blended(), {28, 20});
    expectSameFilm(sides.onDevice(kDefaultTraversal, work, BothSides::Where::storageBuffers).film.pixels,
                   sides.onCpu(work));
}

// The picture has more samples than one dispatch takes and more tiles than a submission has.
TEST_F(PathGpuWork, cutWorkDrawsTheSame) {
    const BothSides sides(gpuPathScenes().front().make(), {100, 70});
    const PathWork many{.samples = 37, .maxBounces = 2};
    const BothSides::DeviceRender whole = sides.onDevice(kDefaultTraversal, many);
    EXPECT_GE(whole.submissions, 4u);
    expectSameFilm(whole.film.pixels, sides.onCpu(many));
}

// Light by scatterings adds up to the radiance, and first hits to the samples that hit something.
TEST_F(PathGpuWork, partsOfTheFilmAreTheSame) {
    const BothSides sides(gpuPathScenes().front().make(), {28, 20});
    const PathWork all{.samples = 21, .filmParts = kFilmLight | kFilmHits};
    const FilmData film = sides.onDevice(kDefaultTraversal, all).film;
    const FilmData expected = sides.filmByJudge(all);
    expectSameFilm(film.pixels, expected.pixels);
    expectSameLight(film.light, expected.light);
    expectSameFilm(film.pixels, sides.onCpu({.samples = 21})); // to ask for parts changes nothing else
    const auto hitsOf = [](const FilmData& of, const std::size_t pixel) {
        std::map<std::uint32_t, std::uint32_t> samples;
        for (const HitCount& hit : of.hits[pixel]) {
            samples[hit.group] += hit.samples;
        }
        return samples;
    };
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        const LightParts& light = film.light[i];
        const glm::vec3 whole = light.emission + light.direct + light.indirect;
        ASSERT_LE(glm::length(whole - film.pixels[i].radiance), 1e-5f * glm::length(whole)) << i;
        sum += glm::dvec3(light.emission.g, light.direct.g, light.indirect.g);
        ASSERT_EQ(hitsOf(film, i), hitsOf(expected, i)) << i;
        float covered = 0.0f;
        for (const HitCount& hit : film.hits[i]) {
            covered += static_cast<float>(hit.samples);
        }
        ASSERT_EQ(covered, film.pixels[i].covered) << i;
    }
    EXPECT_GT(sum.y, 0.0);
    EXPECT_GT(sum.z, 0.0);

    const FilmData direct = sides.filmByJudge({.samples = 2, .maxBounces = 0, .filmParts = kFilmLight});
    for (const LightParts& light : direct.light) {
        ASSERT_EQ(light.indirect, glm::vec3(0.0f));
    }
}

// The picture has more tiles of 8 x 8 pixels than the film on the device, and more than a block of samples.
TEST_F(PathGpuWork, bandsDrawTheSame) {
    const BothSides sides(gpuPathScenes().front().make(), {60, 45});
    const PathWork few{.samples = 19, .maxBounces = 0};
    expectSameFilm(sides.onDevice(kDefaultTraversal, few, BothSides::Where::fasterMemory, 9).film.pixels,
                   sides.onCpu(few));
}

struct FileScene {
    std::string name;
    std::string file; // in the folder of shared scenes, or "scenes/..." for one of the project's
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const FileScene& scene, std::ostream* out) { *out << scene.name; }

class PathGpuFile : public testing::TestWithParam<FileScene> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }
};

TEST_P(PathGpuFile, drawsWhatTheCpuDraws) {
    const std::string& file = GetParam().file;
    PathScene made;
    made.scene = loadScene(file.starts_with("scenes/") ? std::filesystem::path(METAMARCH_SOURCE_DIR) / file
                                                       : sharedScene(file));
    const Sky sky = makeSky({.resolution = 64});
    made.surroundings.environment = sky.environment;
    made.surroundings.sun = sky.sun;
    made.view = made.scene.cameras.empty()
                    ? frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 4.0f / 3.0f)
                    : made.scene.cameras.front();
    const BothSides sides(made, {48, 36});
    const PathWork work{.samples = 4};
    const auto render =
        vulkan::skipUnlessTexelsSuffice([&] { return sides.onDevice(kDefaultTraversal, work); });
    const auto expected = sides.onCpu(work);
    expectPicture(expected);
    expectSameFilm(render.film.pixels, expected);
}

INSTANTIATE_TEST_SUITE_P(
    Files, PathGpuFile,
    testing::Values(FileScene{"cornell", "scenes/cornell.glb"},
                    FileScene{"degenerate", "scenes/degenerate.glb"},
                    FileScene{"objects", "scenes/objects.glb"}, FileScene{"lamps", "scenes/lamps.glb"},
                    FileScene{"interior", "scenes/interior.glb"},
                    FileScene{"shared_cornell", "gltf/CornellBox.glb"},
                    FileScene{"helmet", "gltf/DamagedHelmet.glb"},
                    FileScene{"spheres", "gltf/MetalRoughSpheresNoTextures.glb"},
                    FileScene{"transmission", "gltf/TransmissionTest.glb"},
                    FileScene{"clear_coat", "gltf/ClearCoatTest.glb"},
                    FileScene{"alpha_blend", "gltf/AlphaBlendModeTest.glb"},
                    FileScene{"lamp", "gltf/LightsPunctualLamp/LightsPunctualLamp.gltf"}),
    [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace metamarch::tests
