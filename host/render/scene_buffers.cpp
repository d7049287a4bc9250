#include "render/scene_buffers.h"

#include "error.h"
#include "shader_library.h"
#include "vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::render {
namespace {

constexpr std::uint64_t kRecordBytes = kTriangleWords * sizeof(std::uint32_t);

const Shader& findShader(const std::string& kernel, const std::string& traversal) {
    for (const Shader& shader : shaders()) {
        if (shader.kernel == kernel && shader.traversal == traversal) {
            return shader;
        }
    }
    throw Error(ExitCode::badArguments, fmt::format("--traversal {}: no such traversal; there are: {}",
                                                    traversal, fmt::join(traversals(), ", ")));
}

} // namespace

TriangleChunks chunkTriangles(const std::uint64_t recordCount, const std::uint64_t maxStorageBufferRange) {
    const std::uint64_t perChunk =
        std::min<std::uint64_t>(maxStorageBufferRange / kRecordBytes, 0xffffffffu / kTriangleWords);
    const std::uint64_t count = std::max<std::uint64_t>((recordCount + perChunk - 1) / perChunk, 1);
    if (count > kTriangleChunks) {
        throw Error(ExitCode::outOfMemory,
                    fmt::format("{} triangle references take {} MiB, more than {} buffers of this device's "
                                "maxStorageBufferRange ({} MiB); choose a smaller --tree-depth or --cells",
                                recordCount, recordCount * kRecordBytes >> 20u, kTriangleChunks,
                                maxStorageBufferRange >> 20u));
    }
    return {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(perChunk)};
}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading)
    : chunks(chunkTriangles(structure.tree.leafTriangles.size(), device.report().maxStorageBufferRange)) {
    const auto add = [&]<class T>(const std::uint32_t binding, const std::span<T> values, const char* name) {
        buffers.push_back(vulkan::upload(device, values, name));
        bindings.push_back(binding);
    };
    add(kBindLattice, std::span(&structure.lattice, 1), "lattice");
    add(kBindLeaves, std::span(structure.tree.leaves), "leaves");
    add(kBindTable, std::span(structure.leafOfCell), "meta table");
    add(kBindMaterialOfTriangle, std::span(shading.materialOfTriangle), "material of triangle");
    add(kBindMaterials, std::span(shading.materials), "materials");
    const std::span<const std::uint32_t> words = structure.triangleWords;
    for (std::uint32_t i = 0; i < kTriangleChunks; ++i) {
        const std::size_t chunkWords = std::size_t{chunks.triangles} * kTriangleWords;
        const std::size_t first = std::min(words.size(), i * chunkWords);
        add(kBindTriangles + i, words.subspan(first, std::min(chunkWords, words.size() - first)),
            "triangles");
    }
}

vulkan::ComputePipeline
SceneBuffers::makePipeline(const vulkan::Device& device, const std::string& kernel,
                           const std::string& traversal, const std::uint32_t pushConstantSize,
                           std::map<std::uint32_t, std::uint32_t> specialization) const {
    vulkan::KernelInfo info;
    info.name = kernel + "." + traversal;
    info.spirv = findShader(kernel, traversal).spirv;
    info.storageBindings = bindings;
    info.storageBindings.insert(info.storageBindings.end(), {kBindInput, kBindOutput});
    info.pushConstantSize = pushConstantSize;
    info.specialization = std::move(specialization);
    info.specialization[kSpecTriangleChunks] = chunks.count;
    info.specialization[kSpecTrianglesPerChunk] = chunks.triangles;
    vulkan::ComputePipeline pipeline(device, info);
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        pipeline.bind(bindings[i], buffers[i]);
    }
    return pipeline;
}

std::uint64_t SceneBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const vulkan::Buffer& buffer : buffers) {
        total += buffer.size();
    }
    return total;
}

} // namespace metamarch::render
