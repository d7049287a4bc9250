#include "render/scene_buffers.h"

#include "error.h"
#include "shader_library.h"
#include "vulkan/byte_text.h"
#include "vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::render {
namespace {

constexpr std::uint64_t kRecordBytes = sizeof(TriangleRecord);

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
    const std::uint64_t perChunk = std::min<std::uint64_t>(maxStorageBufferRange / kRecordBytes, 0xffffffffu);
    const std::uint64_t count = std::max<std::uint64_t>((recordCount + perChunk - 1) / perChunk, 1);
    if (count > kTriangleChunks) {
        throw Error(ExitCode::outOfMemory,
                    fmt::format("{} triangle references take {}, more than {} buffers of this device's "
                                "maxStorageBufferRange ({}); choose a smaller --tree-depth or --cells",
                                recordCount, vulkan::byteText(recordCount * kRecordBytes), kTriangleChunks,
                                vulkan::byteText(maxStorageBufferRange)));
    }
    return {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(perChunk)};
}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading)
    : SceneBuffers(device, structure, shading, device.report().maxStorageBufferRange) {}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading, const std::uint64_t maxStorageBufferRange)
    : chunks(chunkTriangles(structure.tree.leafTriangles.size(), maxStorageBufferRange)) {
    const auto add = [&]<class T>(const std::uint32_t binding, const std::span<T> values, const char* name) {
        if (values.size_bytes() > maxStorageBufferRange) {
            throw Error(ExitCode::outOfMemory,
                        fmt::format("the scene's {} takes {}, more than this device's maxStorageBufferRange "
                                    "({}); choose a smaller --tree-depth or --cells",
                                    name, vulkan::byteText(values.size_bytes()),
                                    vulkan::byteText(maxStorageBufferRange)));
        }
        buffers.push_back(vulkan::upload(device, values, name));
        bindings.push_back(binding);
    };
    add(kBindLattice, std::span(&structure.lattice, 1), "lattice");
    add(kBindLeaves, std::span(structure.tree.leaves), "leaves");
    add(kBindTable, std::span(structure.leafOfCell), "meta table");
    add(kBindMaterialOfTriangle, std::span(shading.materialOfTriangle), "material of triangle");
    add(kBindMaterials, std::span(shading.materials), "materials");
    const std::span<const TriangleRecord> triangles = structure.triangles;
    for (std::uint32_t i = 0; i < kTriangleChunks; ++i) {
        const std::size_t first = std::min<std::size_t>(triangles.size(), std::size_t{i} * chunks.triangles);
        const std::size_t count = std::min<std::size_t>(triangles.size() - first, chunks.triangles);
        add(kBindTriangles + i, triangles.subspan(first, count), "triangles");
    }
}

vulkan::ComputePipeline SceneBuffers::makePipeline(const vulkan::Device& device, const std::string& kernel,
                                                   const std::string& traversal,
                                                   vulkan::KernelInfo own) const {
    own.name = kernel + "." + traversal;
    own.spirv = findShader(kernel, traversal).spirv;
    for (const std::uint32_t binding : bindings) {
        (binding == kBindLattice ? own.uniformBindings : own.storageBindings).push_back(binding);
    }
    own.specialization[kSpecTriangleChunks] = chunks.count;
    own.specialization[kSpecTrianglesPerChunk] = chunks.triangles;
    vulkan::ComputePipeline pipeline(device, own);
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
