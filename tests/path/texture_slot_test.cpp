// SPDX-License-Identifier: MIT
// Tests every texture of a material alone: device and CPU draw the same, the texture is visible, and it uses
// the channels that glTF 2.0 and its extensions specify.
#include "fixtures/vulkan_environment.h"
#include "path/both_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <set>
#include <string>
#include <string_view>

namespace metamarch::tests {
namespace {

struct Slot {
    std::string name; // in material_rows.inc
    TextureRef Material::*texture;
    std::string channels; // the channels that glTF specifies
    bool isSrgb;
    std::function<void(Material&)> prepare; // makes the texture have an effect
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it by this name
void PrintTo(const Slot& slot, std::ostream* out) { *out << slot.name; }

void blended(Material& m) { m.alphaMode = AlphaMode::blend; }
void dielectric(Material& m) { m.metallicFactor = 0.0f; }
void glowing(Material& m) { m.emissiveFactor = {0.8f, 0.7f, 0.6f}; }
void thinGlass(Material& m) {
    dielectric(m);
    m.transmissionFactor = 0.9f;
}
void translucent(Material& m) {
    dielectric(m);
    m.diffuseTransmissionFactor = 0.8f;
}
void sheen(Material& m) {
    dielectric(m);
    m.sheenColorFactor = {0.9f, 0.6f, 0.7f};
    m.sheenRoughnessFactor = 0.8f;
}
void coated(Material& m) {
    m.clearcoatFactor = 0.9f;
    m.clearcoatRoughnessFactor = 0.6f;
}
void brushed(Material& m) { m.anisotropyStrength = 0.8f; }
void filmed(Material& m) {
    dielectric(m);
    m.iridescenceFactor = 0.9f;
    m.iridescenceThicknessMaximum = 700.0f;
}

const std::vector<Slot>& slots() {
    static const std::vector<Slot> kSlots = {
        {"baseColorTexture", &Material::baseColorTexture, "rgba", true, blended},
        {"metallicRoughnessTexture", &Material::metallicRoughnessTexture, "gb", false, [](Material&) {}},
        {"normalTexture", &Material::normalTexture, "rgb", false, dielectric},
        {"emissionTexture", &Material::emissiveTexture, "rgb", true, glowing},
        {"transmissionTexture", &Material::transmissionTexture, "r", false, thinGlass},
        {"diffuseTransmissionTexture", &Material::diffuseTransmissionTexture, "a", false, translucent},
        {"diffuseTransmissionColorTexture", &Material::diffuseTransmissionColorTexture, "rgb", true,
         translucent},
        {"specularTexture", &Material::specularTexture, "a", false, dielectric},
        {"specularColorTexture", &Material::specularColorTexture, "rgb", true, dielectric},
        {"sheenColorTexture", &Material::sheenColorTexture, "rgb", true, sheen},
        {"sheenRoughnessTexture", &Material::sheenRoughnessTexture, "a", false, sheen},
        {"coatTexture", &Material::clearcoatTexture, "r", false, coated},
        {"coatRoughnessTexture", &Material::clearcoatRoughnessTexture, "g", false, coated},
        {"coatNormalTexture", &Material::clearcoatNormalTexture, "rgb", false, coated},
        {"anisotropyTexture", &Material::anisotropyTexture, "rgb", false, brushed},
        {"iridescenceTexture", &Material::iridescenceTexture, "r", false, filmed},
        {"iridescenceThicknessTexture", &Material::iridescenceThicknessTexture, "g", false, filmed},
    };
    return kSlots;
}

constexpr std::string_view kChannels = "rgba";

// Adds a texture whose `channels` are waves, each different from the others. The other channels are constant.
std::uint32_t addWaves(Scene& scene, const std::string_view channels) {
    constexpr std::uint32_t kSide = 8;
    std::vector<glm::u8vec4> texels;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const auto x = static_cast<float>(i % kSide);
        const std::uint32_t row = i / kSide;
        const auto y = static_cast<float>(row);
        const glm::vec4 waves =
            glm::sin(glm::vec4(x, y, x + y + 1.0f, 0.7f * x - y) * glm::vec4(1.1f, 0.9f, 0.6f, 1.0f));
        glm::u8vec4 texel(170);
        for (const char channel : channels) {
            const auto k = static_cast<glm::length_t>(kChannels.find(channel));
            texel[k] = static_cast<std::uint8_t>(170.0f + 80.0f * waves[k]);
        }
        texels.push_back(texel);
    }
    return addTexture(scene, kSide, texels, TextureFilter::linear);
}

// Returns a square between two lights. Its texture varies in `channels`; nullptr means that it has no
// texture.
PathScene square(const Slot& slot, const char* const channels) {
    PathScene made;
    Material material = metal({0.9f, 0.7f, 0.5f}, 0.5f);
    slot.prepare(material);
    if (channels != nullptr) {
        material.*slot.texture = {addWaves(made.scene, channels), 0, slot.isSrgb};
    }
    addQuad(made.scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, addMaterial(made.scene, material));
    made.scene.tangents.assign(made.scene.positions.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    addPointLight(made.scene, {0.6f, 0.8f, 1.2f}, 4.0f);
    addPointLight(made.scene, {-0.5f, 0.4f, -1.2f}, 3.0f);
    made.surroundings.background = {0.3f, 0.4f, 0.5f};
    made.view = lookAt({0.9f, -0.6f, 2.2f}, {0, 0, 0}, {0, 1, 0});
    return made;
}

const PathWork kWork{.samples = 4, .maxBounces = 2};
constexpr Picture kPicture{24, 20};

std::vector<FilmPixel> onCpu(const Slot& slot, const char* const channels) {
    return BothSides(square(slot, channels), kPicture).onCpu(kWork);
}

bool isSameFilm(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b) {
    return std::ranges::equal(a, b, isSamePixel);
}

class TextureSlot : public testing::TestWithParam<Slot> {
  protected:
    void TearDown() override { EXPECT_EQ(vulkan::validationMessages(), 0u); }
};

TEST_P(TextureSlot, isSeenAndDrawnAsTheCpuDraws) {
    const BothSides sides(square(GetParam(), "rgba"), kPicture);
    const std::vector<FilmPixel> expected = sides.onCpu(kWork);
    expectPicture(expected);
    EXPECT_FALSE(isSameFilm(expected, onCpu(GetParam(), nullptr))) << "the texture changes nothing";
    expectSameFilm(sides.onDevice(kDefaultTraversal, kWork).film.pixels, expected);
}

TEST_P(TextureSlot, countsTheChannelsThatGltfNames) {
    const std::vector<FilmPixel> constant = onCpu(GetParam(), "");
    for (const char channel : kChannels) {
        const bool isNamed = GetParam().channels.find(channel) != std::string::npos;
        const std::string varying(1, channel);
        EXPECT_EQ(isSameFilm(onCpu(GetParam(), varying.c_str()), constant), !isNamed) << channel;
    }
}

INSTANTIATE_TEST_SUITE_P(Slots, TextureSlot, testing::ValuesIn(slots()),
                         [](const auto& instance) { return instance.param.name; });

TEST(TextureSlots, areAllHere) {
    std::set<std::string> expected;
#define PARAMETER(type, name, value)
#define TEXTURE(name, value) expected.insert(#name);
#include "metamarch/shared/material_rows.inc"
    std::set<std::string> tested;
    for (const Slot& slot : slots()) {
        tested.insert(slot.name);
        Material material;
        EXPECT_EQ(std::ranges::count(texturesOf(material), &(material.*slot.texture)), 1) << slot.name;
    }
    EXPECT_EQ(tested, expected);
}

} // namespace
} // namespace metamarch::tests
