// SPDX-License-Identifier: MIT
// The kernels that the processor executes make the judge's film bit by bit, for each set of instructions.
#include "fixtures/shared_scenes.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/light/sky.h"
#include "path/cpu_side.h"
#include "path/gpu_scenes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <map>

namespace metamarch::tests {
namespace {

void expectEqualBits(const FilmData& film, const FilmData& expected) {
    ASSERT_EQ(film.pixels.size(), expected.pixels.size());
    ASSERT_EQ(film.light.size(), expected.light.size());
    ASSERT_EQ(film.hits.size(), expected.hits.size());
    const auto hitsOf = [](const FilmData& of, const std::size_t pixel) {
        std::map<std::uint32_t, std::uint32_t> samples;
        for (const HitCount& hit : of.hits[pixel]) {
            samples[hit.group] += hit.samples;
        }
        return samples;
    };
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        ASSERT_TRUE(isSamePixel(film.pixels[i], expected.pixels[i]))
            << "pixel " << i << ": green " << film.pixels[i].radiance.g << ", expected "
            << expected.pixels[i].radiance.g;
        if (!film.light.empty()) {
            ASSERT_EQ(std::memcmp(&film.light[i], &expected.light[i], sizeof(LightParts)), 0)
                << "pixel " << i;
        }
        if (!film.hits.empty()) {
            ASSERT_EQ(hitsOf(film, i), hitsOf(expected, i)) << "pixel " << i;
        }
    }
}

void expectJudgesFilm(const CpuSide& side, const PathWork& work) {
    const FilmData expected = side.filmByJudge(work);
    for (const ProcessorKernel& kernel : side.kernels()) {
        SCOPED_TRACE(kernel.name);
        expectEqualBits(side.filmOnCpu(work, kernel.run), expected);
    }
}

class PathProcessor : public testing::TestWithParam<GpuPathScene> {};

TEST_P(PathProcessor, drawsWhatTheJudgeDraws) {
    PathWork work = GetParam().work;
    work.filmParts |= kFilmLight | kFilmHits;
    expectJudgesFilm(CpuSide(GetParam().make(), {work.side + 12, work.side + 4}), work);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathProcessor, testing::ValuesIn(gpuPathScenes()),
                         [](const auto& instance) { return instance.param.name; });

class PathProcessorFile : public testing::TestWithParam<const char*> {};

// The last tiles of the picture are cut, and it has more than one block of samples.
TEST_P(PathProcessorFile, drawsWhatTheJudgeDraws) {
    PathScene made;
    made.scene = loadScene(sharedScene(GetParam()));
    const Sky sky = makeSky({.resolution = 64});
    made.surroundings.environment = sky.environment;
    made.surroundings.sun = sky.sun;
    made.view = frameBounds(boundsOf(made.scene), kDefaultVerticalFov, 4.0f / 3.0f);
    expectJudgesFilm(CpuSide(made, {37, 27}), {.samples = 18});
}

INSTANTIATE_TEST_SUITE_P(Shared, PathProcessorFile,
                         testing::Values("gltf/DamagedHelmet.glb", "gltf/AlphaBlendModeTest.glb",
                                         "gltf/ClearCoatTest.glb"),
                         [](const auto& instance) {
                             return std::filesystem::path(instance.param).stem().string();
                         });

// The plain kernel is for scenes without the rare features alone.
TEST(PathKernels, leaveOutWhatNoSceneUses) {
    const std::size_t plain = pathKernels(kFeatureLights).size();
    const std::size_t whole = pathKernels(kFeatureCoat).size();
    EXPECT_GE(whole, 1u);
    EXPECT_GE(plain, whole);
    for (const ProcessorKernel& kernel : pathKernels(kFeatureCoat)) {
        EXPECT_TRUE(kernel.name.starts_with("path_")) << kernel.name;
    }
}

} // namespace
} // namespace metamarch::tests
