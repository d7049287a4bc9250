// SPDX-License-Identifier: MIT
#include "metamarch/render/shading_buffers.h"

#include "metamarch/vulkan/transfer.h"

#include <vector>

namespace metamarch::render {
namespace {

// Bindings whose entries are single words; all others have four.
bool isTexels(const std::uint32_t binding) {
    return binding >= kBindTexels && binding < kBindTexels + kTexelChunks;
}

} // namespace

ShadingBuffers::ShadingBuffers(const vulkan::Device& device, const ShadingScene& scene)
    : features(scene.features) {
    const auto add = [&](const std::uint32_t binding, const auto& values, const char* name) {
        const std::span<const std::byte> data = std::as_bytes(std::span(values));
        // A buffer view needs at least one entry, even if the scene has none.
        static constexpr std::array<std::byte, 16> kNone{};
        buffers.emplace(binding, vulkan::upload(device, data.empty() ? std::span(kNone) : data, name));
    };
    add(kBindSurfaces, scene.surfaces, "surfaces");
    add(kBindVertices, scene.vertices, "vertices");
    add(kBindColors, scene.colors, "vertex colours");
    add(kBindTangents, scene.tangents, "tangents");
    add(kBindMaterialRecords, scene.materials, "materials");
    add(kBindTextures, scene.textures, "textures");
    add(kBindEmitters, scene.emitters, "emitters");
    // The nodes of the tree of lights follow: see lib/shading.glsl.
    std::vector<std::byte> lights;
    for (const auto part :
         {std::as_bytes(std::span(scene.lights)), std::as_bytes(std::span(scene.lightNodes))}) {
        lights.insert(lights.end(), part.begin(), part.end());
    }
    add(kBindLights, lights, "lights");
    add(kBindTables, scene.tables, "light tables");
    add(kBindEnvironment, scene.environment, "environment");
    for (std::uint32_t i = 0; i < kTexelChunks; ++i) {
        add(kBindTexels + i, scene.texels[i], "texels");
    }
}

void ShadingBuffers::addTo(vulkan::KernelInfo& kernel, const std::uint32_t ofCamera) const {
    for (const auto& [binding, buffer] : buffers) {
        kernel.texelBindings.emplace(binding,
                                     isTexels(binding) ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32B32A32_UINT);
    }
    kernel.specialization[kSpecFeatures] = features | ofCamera;
}

void ShadingBuffers::bindTo(vulkan::ComputePipeline& pipeline) const {
    for (const auto& [binding, buffer] : buffers) {
        pipeline.bind(binding, buffer);
    }
}

std::uint64_t ShadingBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const auto& [binding, buffer] : buffers) {
        total += buffer.size();
    }
    return total;
}

} // namespace metamarch::render
