#include "render/scene_buffers.h"

#include "error.h"
#include "shader_library.h"
#include "vulkan/byte_text.h"
#include "vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

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

// What a traversal's structure consists of on the device.
struct StructureParts {
    std::string_view name; // in shaders/CMakeLists.txt
    TriangleOrder order;
    std::vector<std::uint32_t> bindings;
};

const StructureParts& findStructure(const std::string_view name) {
    static const StructureParts kStructures[] = {
        {"meta_table", TriangleOrder::kdLeaves, {kBindLeaves, kBindTable}},
        {"kd_tree", TriangleOrder::kdLeaves, {kBindLeaves, kBindKdNodes}},
        {"kd_parents", TriangleOrder::kdLeaves, {kBindLeaves, kBindKdNodes, kBindKdParents}},
        {"kd_ropes", TriangleOrder::kdLeaves, {kBindLeaves, kBindKdNodes, kBindKdRopes}},
        {"bvh", TriangleOrder::bvhLeaves, {kBindBvhNodes}},
        {"uniform_grid", TriangleOrder::gridCells, {kBindGrid, kBindGridCells}},
        {"triangles", TriangleOrder::ascending, {}},
    };
    const auto found = std::ranges::find(kStructures, name, &StructureParts::name);
    if (found == std::end(kStructures)) {
        throw std::logic_error(fmt::format("no structure '{}'", name));
    }
    return *found;
}

// What lies behind a binding of some structure.
struct Content {
    std::span<const std::byte> data;
    const char* name;
};

Content contentOf(const StructureSet& set, const std::uint32_t binding) {
    switch (binding) {
    case kBindLeaves:
        return {std::as_bytes(std::span(set.kdTree().tree.leaves)), "leaves"};
    case kBindTable:
        return {std::as_bytes(std::span(set.kdTree().leafOfCell)), "meta table"};
    case kBindKdNodes:
        return {std::as_bytes(std::span(set.kdTree().tree.nodes)), "kd-tree nodes"};
    case kBindKdParents:
        return {std::as_bytes(std::span(set.kdParents())), "kd-tree parents"};
    case kBindKdRopes:
        return {std::as_bytes(std::span(set.kdRopes())), "kd-tree ropes"};
    case kBindBvhNodes:
        return {std::as_bytes(std::span(set.bvh().nodes)), "BVH nodes"};
    case kBindGrid:
        return {std::as_bytes(std::span(&set.uniformGrid().grid, 1)), "grid"};
    case kBindGridCells:
        return {std::as_bytes(std::span(set.uniformGrid().cells)), "grid cells"};
    default:
        throw std::logic_error(fmt::format("no structure has binding {}", binding));
    }
}

std::span<const TriangleRecord> recordsIn(const StructureSet& set, const TriangleOrder order) {
    switch (order) {
    case TriangleOrder::kdLeaves:
        return set.kdTree().triangles;
    case TriangleOrder::bvhLeaves:
        return set.bvh().triangles;
    case TriangleOrder::gridCells:
        return set.uniformGrid().triangles;
    case TriangleOrder::ascending:
        return set.triangles();
    }
    throw std::logic_error("no such order of triangles");
}

bool isUniform(const std::uint32_t binding) { return binding == kBindLattice || binding == kBindGrid; }

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
    : maxRange(maxStorageBufferRange), set(std::make_unique<StructureSet>(structure)) {
    add(device, kBindLattice, std::as_bytes(std::span(&structure.lattice, 1)), "lattice");
    add(device, kBindMaterialOfTriangle, std::as_bytes(std::span(shading.materialOfTriangle)),
        "material of triangle");
    add(device, kBindMaterials, std::as_bytes(std::span(shading.materials)), "materials");
    addStructure(device, shaders().front().structure);
}

vulkan::Buffer SceneBuffers::upload(const vulkan::Device& device, const std::span<const std::byte> data,
                                    const char* name) const {
    if (data.size() > maxRange) {
        throw Error(ExitCode::outOfMemory,
                    fmt::format("the scene's {} takes {}, more than this device's maxStorageBufferRange "
                                "({}); choose a smaller --tree-depth or --cells",
                                name, vulkan::byteText(data.size()), vulkan::byteText(maxRange)));
    }
    return vulkan::upload(device, data, name);
}

void SceneBuffers::add(const vulkan::Device& device, const std::uint32_t binding,
                       const std::span<const std::byte> data, const char* name) const {
    buffers.emplace(binding, upload(device, data, name));
}

void SceneBuffers::addStructure(const vulkan::Device& device, const std::string_view structure) const {
    const StructureParts& parts = findStructure(structure);
    if (!triangles.contains(parts.order)) {
        const std::span<const TriangleRecord> records = recordsIn(*set, parts.order);
        TriangleBuffers added{chunkTriangles(records.size(), maxRange), {}};
        for (std::uint32_t i = 0; i < kTriangleChunks; ++i) {
            const std::size_t first =
                std::min<std::size_t>(records.size(), std::size_t{i} * added.chunks.triangles);
            const std::size_t count = std::min<std::size_t>(records.size() - first, added.chunks.triangles);
            added.buffers.push_back(
                upload(device, std::as_bytes(records.subspan(first, count)), "triangles"));
        }
        triangles.emplace(parts.order, std::move(added));
    }
    for (const std::uint32_t binding : parts.bindings) {
        if (!buffers.contains(binding)) {
            const Content content = contentOf(*set, binding);
            add(device, binding, content.data, content.name);
        }
    }
}

vulkan::ComputePipeline SceneBuffers::makePipeline(const vulkan::Device& device, const std::string& kernel,
                                                   const std::string& traversal,
                                                   vulkan::KernelInfo own) const {
    const Shader& shader = findShader(kernel, traversal);
    addStructure(device, shader.structure);
    const StructureParts& parts = findStructure(shader.structure);
    const TriangleBuffers& records = triangles.at(parts.order);

    std::vector<std::pair<std::uint32_t, const vulkan::Buffer*>> used;
    for (const std::uint32_t binding : {kBindLattice, kBindMaterialOfTriangle, kBindMaterials}) {
        used.emplace_back(binding, &buffers.at(binding));
    }
    for (const std::uint32_t binding : parts.bindings) {
        used.emplace_back(binding, &buffers.at(binding));
    }
    for (std::uint32_t i = 0; i < kTriangleChunks; ++i) {
        used.emplace_back(kBindTriangles + i, &records.buffers[i]);
    }

    own.name = kernel + "." + traversal;
    own.spirv = shader.spirv;
    for (const auto& [binding, buffer] : used) {
        (isUniform(binding) ? own.uniformBindings : own.storageBindings).push_back(binding);
    }
    own.specialization[kSpecTriangleChunks] = records.chunks.count;
    own.specialization[kSpecTrianglesPerChunk] = records.chunks.triangles;
    vulkan::ComputePipeline pipeline(device, own);
    for (const auto& [binding, buffer] : used) {
        pipeline.bind(binding, *buffer);
    }
    return pipeline;
}

std::uint64_t SceneBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const auto& [binding, buffer] : buffers) {
        total += buffer.size();
    }
    for (const auto& [order, records] : triangles) {
        for (const vulkan::Buffer& buffer : records.buffers) {
            total += buffer.size();
        }
    }
    return total;
}

} // namespace metamarch::render
