// SPDX-License-Identifier: MIT
#include "metamarch/render/scene_buffers.h"

#include "metamarch/accel/structure.h"
#include "metamarch/accel/triangle_box.h"
#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>

namespace metamarch::render {
namespace {

constexpr std::uint64_t kRecordBytes = sizeof(TriangleRecord);

const Shader& findShader(const std::string& kernel, const std::string& traversal, const Memory memory) {
    for (const Shader& shader : shaders()) {
        if (shader.kernel == kernel && shader.traversal == traversal && shader.memory == memory) {
            return shader;
        }
    }
    throw Error(
        ErrorKind::invalidArgument,
        fmt::format("there is no traversal {}; there are: {}", traversal, fmt::join(traversals(), ", ")),
        {"traversal"});
}

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

using Triangles = std::span<const TriangleRecord>;

constexpr VkFormat kFourWords = VK_FORMAT_R32G32B32A32_UINT;

VkFormat formatOf(const StructurePart& part) {
    return part.words == 1 ? VK_FORMAT_R32_UINT : part.words == 2 ? VK_FORMAT_R32G32_UINT : kFourWords;
}

std::vector<VkAabbPositionsKHR> boxesAround(const Lattice& lattice, const Triangles triangles) {
    std::vector<VkAabbPositionsKHR> boxes(triangles.size());
    std::ranges::transform(triangles, boxes.begin(), [&](const TriangleRecord& triangle) {
        const Box box = boxOf(lattice, triangle);
        const vec3 lo = lowCorner(box);
        const vec3 hi = highCorner(box);
        return VkAabbPositionsKHR{lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
    });
    return boxes;
}

} // namespace

std::vector<std::string> missingFor(const vulkan::DeviceReport& device, const std::string_view traversal) {
    const std::string_view structure = structureOf(traversal);
    const bool isWalkedByDriver = !structure.empty() && findStructure(structure).isWalkedByDriver;
    return isWalkedByDriver ? device.missingForRayQuery : std::vector<std::string>();
}

void requireTraversal(const vulkan::DeviceReport& device, const std::string_view traversal) {
    const std::vector<std::string> missing = missingFor(device, traversal);
    if (!missing.empty()) {
        throw Error(
            ErrorKind::noDevice,
            fmt::format("traversal {}: {} lacks {}", traversal, device.name, fmt::join(missing, ", ")),
            {"traversal"});
    }
}

Memory fasterMemory(const vulkan::DeviceReport& device) {
    return device.driver == "llvmpipe" || !device.runsWithStorageBuffers() ? Memory::texel : Memory::storage;
}

TriangleChunks chunkTriangles(const std::uint64_t recordCount, const std::uint64_t maxStorageBufferRange) {
    const std::uint64_t perChunk = std::min<std::uint64_t>(maxStorageBufferRange / kRecordBytes, 0xffffffffu);
    const std::uint64_t count = std::max<std::uint64_t>((recordCount + perChunk - 1) / perChunk, 1);
    if (count > kTriangleChunks) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("{} triangle references take {}, more than {} buffers of this device's "
                                "maxStorageBufferRange ({}); choose a smaller tree depth or fewer cells",
                                recordCount, vulkan::byteText(recordCount * kRecordBytes), kTriangleChunks,
                                vulkan::byteText(maxStorageBufferRange)),
                    {"treeDepth", "cells"});
    }
    return {static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(perChunk)};
}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading)
    : SceneBuffers(device, structure, shading, fasterMemory(device.report()),
                   device.report().maxStorageBufferRange) {}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading, const std::uint64_t maxStorageBufferRange)
    : SceneBuffers(device, structure, shading, Memory::storage, maxStorageBufferRange) {}

SceneBuffers::SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                           const ShadingData& shading, const Memory usedMemory,
                           const std::uint64_t maxStorageBufferRange)
    : memory(usedMemory), maxRange(maxStorageBufferRange), set(std::make_unique<StructureSet>(structure)) {
    const auto add = [&](const std::uint32_t binding, const std::span<const std::byte> data,
                         const char* name) { buffers.emplace(binding, upload(device, data, name)); };
    add(kBindLattice, std::as_bytes(std::span(&structure.lattice, 1)), "lattice");
    add(kBindMaterialOfTriangle, bytesOf(shading.materialOfTriangle), "material of triangle");
    add(kBindMaterials, bytesOf(shading.materials), "materials");
    addStructure(device, shaders().front().structure);
}

vulkan::Buffer SceneBuffers::upload(const vulkan::Device& device, const std::span<const std::byte> data,
                                    const char* name) const {
    if (memory == Memory::storage && data.size() > maxRange) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("the scene's {} takes {}, more than this device's maxStorageBufferRange "
                                "({}); choose a smaller tree depth or fewer cells",
                                name, vulkan::byteText(data.size()), vulkan::byteText(maxRange)),
                    {"treeDepth", "cells"});
    }
    return vulkan::upload(device, data, name);
}

SceneBuffers::TriangleBuffers SceneBuffers::uploadTriangles(const vulkan::Device& device,
                                                            const Triangles records) const {
    if (memory == Memory::texel) {
        TriangleBuffers whole{{1, 0xffffffffu}, {}};
        whole.buffers.push_back(upload(device, std::as_bytes(records), "triangles"));
        return whole;
    }
    TriangleBuffers cut{chunkTriangles(records.size(), maxRange), {}};
    for (std::uint32_t i = 0; i < kTriangleChunks; ++i) {
        const std::size_t first =
            std::min<std::size_t>(records.size(), std::size_t{i} * cut.chunks.triangles);
        const std::size_t count = std::min<std::size_t>(records.size() - first, cut.chunks.triangles);
        cut.buffers.push_back(upload(device, std::as_bytes(records.subspan(first, count)), "triangles"));
    }
    return cut;
}

void SceneBuffers::addStructure(const vulkan::Device& device, const std::string_view name) const {
    const Structure& structure = findStructure(name);
    const Triangles records = structure.triangles(*set);
    if (!triangles.contains(records.data())) {
        triangles.emplace(records.data(), uploadTriangles(device, records));
    }
    for (const StructurePart& part : structure.parts) {
        const std::span<const std::byte> data = part.data(*set);
        if (!parts.contains(data.data())) {
            parts.emplace(data.data(), upload(device, data, part.name));
        }
    }
    if (structure.isWalkedByDriver && !boxes) {
        boxes.emplace(device, boxesAround(set->kdTree().lattice, records), "box hierarchy");
    }
}

vulkan::ComputePipeline SceneBuffers::makePipeline(const vulkan::Device& device, const std::string& kernel,
                                                   const std::string& traversal,
                                                   vulkan::KernelInfo own) const {
    const Shader& shader = findShader(kernel, traversal, memory);
    requireTraversal(device.report(), traversal);
    addStructure(device, shader.structure);
    const Structure& structure = findStructure(shader.structure);
    const TriangleBuffers& records = triangles.at(structure.triangles(*set).data());

    own.name = traversal.empty() ? kernel : kernel + "." + traversal;
    if (own.spirv.empty()) {
        own.spirv = shader.spirv;
    }
    own.uniformBindings.push_back(kBindLattice);
    own.storageBindings.push_back(kBindMaterialOfTriangle);
    own.storageBindings.push_back(kBindMaterials);
    for (const StructurePart& part : structure.parts) {
        if (part.words == 0) {
            own.uniformBindings.push_back(part.binding);
        } else {
            own.texelBindings.emplace(part.binding, formatOf(part));
        }
    }
    for (std::uint32_t i = 0; i < records.buffers.size(); ++i) {
        own.texelBindings.emplace(kBindTriangles + i, kFourWords);
    }
    if (structure.isWalkedByDriver) {
        own.hierarchyBindings.push_back(kBindBoxes);
    }
    if (memory == Memory::storage) {
        for (const auto& [binding, format] : own.texelBindings) {
            own.storageBindings.push_back(binding);
        }
        own.texelBindings.clear();
        own.specialization[kSpecTriangleChunks] = records.chunks.count;
        own.specialization[kSpecTrianglesPerChunk] = records.chunks.triangles;
    }

    vulkan::ComputePipeline pipeline(device, own);
    for (const auto& [binding, buffer] : buffers) {
        pipeline.bind(binding, buffer);
    }
    for (const StructurePart& part : structure.parts) {
        pipeline.bind(part.binding, parts.at(part.data(*set).data()));
    }
    for (std::uint32_t i = 0; i < records.buffers.size(); ++i) {
        pipeline.bind(kBindTriangles + i, records.buffers[i]);
    }
    if (structure.isWalkedByDriver) {
        pipeline.bind(kBindBoxes, *boxes);
    }
    return pipeline;
}

std::uint64_t SceneBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const auto& [binding, buffer] : buffers) {
        total += buffer.size();
    }
    for (const auto& [data, buffer] : parts) {
        total += buffer.size();
    }
    for (const auto& [first, records] : triangles) {
        for (const vulkan::Buffer& buffer : records.buffers) {
            total += buffer.size();
        }
    }
    return total + (boxes ? boxes->size() : 0);
}

} // namespace metamarch::render
