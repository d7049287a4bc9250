// SPDX-License-Identifier: MIT
// The device assembles structs from words: each member must be the word at that place of the host's struct.
#include "fixtures/vulkan_environment.h"
#include "kernels/loaders_storage.h"
#include "kernels/loaders_texel.h"
#include "loaded_records.h"
#include "metamarch/render/shading_buffers.h"
#include "metamarch/shared/features.h"
#include "metamarch/shared/scene_layout.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>

namespace metamarch::vulkan {
namespace {

constexpr std::uint32_t kRecords = kLoadedRecords;

// Fills all buffers so that every word, except padding, is a different number in [1, 2).
ShadingScene sceneOfDistinctWords() {
    ShadingScene scene;
    std::uint32_t next = 0x3f800000u;
    const auto fill = [&](auto& records) {
        records.resize(kRecords);
        for (auto& record : records) {
            std::array<std::uint32_t, sizeof(record) / sizeof(std::uint32_t)> words;
            for (std::uint32_t& word : words) {
                word = next++;
            }
            std::memcpy(&record, words.data(), sizeof(record));
        }
    };
    fill(scene.surfaces);
    fill(scene.vertices);
    fill(scene.colors);
    fill(scene.tangents);
    fill(scene.materials);
    fill(scene.textures);
    fill(scene.emitters);
    fill(scene.lights);
    fill(scene.lightNodes);
    fill(scene.tables);
    fill(scene.environment);
    for (auto& chunk : scene.texels) {
        fill(chunk);
    }
    return scene;
}

std::vector<LoadedRecords> load(const ShadingScene& scene, const bool isTexel) {
    const Device& device = testDevice();
    const render::ShadingBuffers buffers(device, scene);
    const Buffer output(device, BufferUse::storage, kRecords * sizeof(LoadedRecords), "loaded records");
    KernelInfo info;
    info.name = "loaders";
    info.spirv = isTexel ? std::span<const std::uint32_t>(loaders_texelSpirv) : loaders_storageSpirv;
    buffers.addTo(info, 0);
    info.storageBindings = {kBindOutput};
    if (!isTexel) {
        for (const auto& [binding, format] : info.texelBindings) {
            info.storageBindings.push_back(binding);
        }
        info.texelBindings.clear();
    }
    ComputePipeline pipeline(device, info);
    buffers.bindTo(pipeline);
    pipeline.bind(kBindOutput, output);
    Submission(device).run([&](Commands& commands) { commands.dispatch(pipeline, {kRecords, 1, 1}); });
    return download<LoadedRecords>(device, output);
}

class Loaders : public testing::TestWithParam<bool> {
  protected:
    void TearDown() override { EXPECT_EQ(validationMessages(), 0u); }
};

TEST_P(Loaders, putEveryWordWhereTheStructHasIt) {
    ShadingScene scene = sceneOfDistinctWords();
    scene.features = kAllFeatures;
    const std::vector<LoadedRecords> loaded = load(scene, GetParam());
    using Words = std::array<std::uint32_t, sizeof(LoadedRecords) / sizeof(std::uint32_t)>;
    for (std::uint32_t i = 0; i < kRecords; ++i) {
        const auto found = std::bit_cast<Words>(loaded[i]);
        const auto expected = std::bit_cast<Words>(loadedRecords(scene, i));
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k], expected[k]) << "word " << k << " of LoadedRecords, record " << i;
        }
    }
}

// Returns the scene's materials as a kernel with these features must load them according to
// material_rows.inc.
MaterialRecord seenWith(const std::uint32_t features, const MaterialRecord& whole) {
    const auto hasFeature = [&](const std::uint32_t feature) { return (features & feature) != 0u; };
    MaterialRecord seen = whole;
#define PARAMETER(type, name, value) seen.name = type(0);
#define TEXTURE(name, value) seen.name = kNoTextureRecord;
#define MATERIAL_ROW(condition, X, Y, Z, W)                                                                  \
    if (!(condition)) {                                                                                      \
        X Y Z W                                                                                              \
    }
#define MATERIAL_VECTOR_ROW(condition, XYZ, W) MATERIAL_ROW(condition, XYZ, , , W)
#include "metamarch/shared/material_rows.inc"
    return seen;
}

void expectSameMaterial(const MaterialRecord& found, const MaterialRecord& expected) {
#define PARAMETER(type, name, value) EXPECT_EQ(found.name, expected.name) << #name;
#define TEXTURE(name, value) EXPECT_EQ(found.name, expected.name) << #name;
#include "metamarch/shared/material_rows.inc"
}

TEST_P(Loaders, readOnlyTheRowsWhoseConditionHolds) {
    ShadingScene scene = sceneOfDistinctWords();
    for (const std::uint32_t features : {0u, kFeatureTextures, kAllFeatures & ~kFeatureTextures}) {
        SCOPED_TRACE(features);
        scene.features = features;
        const std::vector<LoadedRecords> loaded = load(scene, GetParam());
        for (std::uint32_t i = 0; i < kRecords; ++i) {
            expectSameMaterial(loaded[i].material, seenWith(features, scene.materials[i]));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Memory, Loaders, testing::Bool(), [](const auto& instance) {
    return std::string(instance.param ? "texel" : "storage");
});

} // namespace
} // namespace metamarch::vulkan
