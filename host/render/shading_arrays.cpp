// SPDX-License-Identifier: MIT
#include "metamarch/render/shading_arrays.h"

namespace metamarch::render {

ShadingArrays::ShadingArrays(const ShadingScene& scene) {
    const auto add = [&](const std::uint32_t binding, const auto& values, const char* name) {
        const std::span<const std::byte> data = std::as_bytes(std::span(values));
        // A buffer view needs at least one entry, and so do the lanes of the processor. No entry is larger.
        static constexpr std::array<std::byte, sizeof(MaterialRecord)> kNone{};
        arrays_.push_back({binding, name, data.empty() ? std::span(kNone) : data});
    };
    add(kBindSurfaces, scene.surfaces, "surfaces");
    add(kBindVertices, scene.vertices, "vertices");
    add(kBindColors, scene.colors, "vertex colours");
    add(kBindTangents, scene.tangents, "tangents");
    add(kBindMaterialRecords, scene.materials, "materials");
    add(kBindTextures, scene.textures, "textures");
    add(kBindEmitters, scene.emitters, "emitters");
    // The nodes of the tree of lights follow: see lib/shading.glsl.
    for (const auto part :
         {std::as_bytes(std::span(scene.lights)), std::as_bytes(std::span(scene.lightNodes))}) {
        lights_.insert(lights_.end(), part.begin(), part.end());
    }
    add(kBindLights, lights_, "lights");
    add(kBindTables, scene.tables, "light tables");
    add(kBindEnvironment, scene.environment, "environment");
    for (std::uint32_t i = 0; i < kTexelChunks; ++i) {
        add(kBindTexels + i, scene.texels[i], "texels");
    }
}

} // namespace metamarch::render
