#include "metamarch/render/scene_buffers.h"

#include "metamarch/accel/triangle_box.h"
#include "metamarch/error/error.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

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

} // namespace

// A buffer of a traversal's structure, which several structures may share.
struct StructurePart {
    const char* name;
    std::uint32_t binding;
    vk::Format format; // of an entry; undefined for constants, which lie in a uniform buffer
    std::span<const std::byte> (*data)(const StructureSet& set);
};

namespace {

constexpr vk::Format kOneWord = vk::Format::eR32Uint;
constexpr vk::Format kTwoWords = vk::Format::eR32G32Uint;
constexpr vk::Format kFourWords = vk::Format::eR32G32B32A32Uint;

constexpr StructurePart kTreeLeaves = {"leaves", kBindLeaves, kFourWords, [](const StructureSet& set) {
                                           return bytesOf(set.kdTree().tree.leaves);
                                       }};
constexpr StructurePart kExitBoxes = {"exit boxes", kBindLeaves, kFourWords, [](const StructureSet& set) {
                                          return bytesOf(set.kdTree().table.leaves);
                                      }};
constexpr StructurePart kTable = {"meta table", kBindTable, kOneWord,
                                  [](const StructureSet& set) { return bytesOf(set.kdTree().table.words); }};
constexpr StructurePart kKdNodes = {"kd-tree nodes", kBindKdNodes, kTwoWords,
                                    [](const StructureSet& set) { return bytesOf(set.kdTree().tree.nodes); }};
constexpr StructurePart kKdParents = {"kd-tree parents", kBindKdParents, kFourWords,
                                      [](const StructureSet& set) { return bytesOf(set.kdParents()); }};
constexpr StructurePart kKdRopes = {"kd-tree ropes", kBindKdRopes, kOneWord,
                                    [](const StructureSet& set) { return bytesOf(set.kdRopes()); }};
constexpr StructurePart kBvhNodes = {"BVH nodes", kBindBvhNodes, kFourWords,
                                     [](const StructureSet& set) { return bytesOf(set.bvh().nodes); }};
constexpr StructurePart kGrid = {"grid", kBindGrid, vk::Format::eUndefined, [](const StructureSet& set) {
                                     return std::as_bytes(std::span(&set.uniformGrid().grid, 1));
                                 }};
constexpr StructurePart kGridCells = {"grid cells", kBindGridCells, kTwoWords, [](const StructureSet& set) {
                                          return bytesOf(set.uniformGrid().cells);
                                      }};

constexpr StructurePart kRectilinear = {
    "rectilinear lattice", kBindRectilinear, vk::Format::eUndefined, [](const StructureSet& set) {
        return std::as_bytes(std::span(&set.rectilinearTable().planes.layout(), 1));
    }};
constexpr StructurePart kPlanes = {"planes", kBindPlanes, kOneWord, [](const StructureSet& set) {
                                       return bytesOf(set.rectilinearTable().planes.planes());
                                   }};
constexpr StructurePart kBuckets = {"plane look-ups", kBindBuckets, kOneWord, [](const StructureSet& set) {
                                        return bytesOf(set.rectilinearTable().planes.buckets());
                                    }};
constexpr StructurePart kRectilinearExitBoxes = {
    "rectilinear exit boxes", kBindLeaves, kFourWords,
    [](const StructureSet& set) { return bytesOf(set.rectilinearTable().table.leaves); }};
constexpr StructurePart kRectilinearTable = {
    "rectilinear table", kBindTable, kOneWord,
    [](const StructureSet& set) { return bytesOf(set.rectilinearTable().table.words); }};

using Triangles = std::span<const TriangleRecord>;

Triangles inTreeLeaves(const StructureSet& set) { return set.kdTree().triangles; }
Triangles inTableLeaves(const StructureSet& set) { return set.kdTree().tableTriangles(); }

// What a traversal walks, and in which order the triangle records lie.
struct Structure {
    std::string_view name; // in shaders/CMakeLists.txt
    Triangles (*triangles)(const StructureSet& set);
    std::vector<const StructurePart*> parts;
    bool inBoxes = false; // the driver walks a hierarchy of its own over the records' boxes
};

const Structure& findStructure(const std::string_view name) {
    static const Structure kStructures[] = {
        {"meta_table", inTableLeaves, {&kExitBoxes, &kTable}},
        {"rectilinear_table",
         [](const StructureSet& set) -> Triangles { return set.rectilinearTable().table.triangles; },
         {&kRectilinear, &kPlanes, &kBuckets, &kRectilinearExitBoxes, &kRectilinearTable}},
        {"kd_tree", inTreeLeaves, {&kTreeLeaves, &kKdNodes}},
        {"kd_parents", inTreeLeaves, {&kTreeLeaves, &kKdNodes, &kKdParents}},
        {"kd_ropes", inTreeLeaves, {&kTreeLeaves, &kKdNodes, &kKdRopes}},
        {"bvh", [](const StructureSet& set) -> Triangles { return set.bvh().triangles; }, {&kBvhNodes}},
        {"uniform_grid",
         [](const StructureSet& set) -> Triangles { return set.uniformGrid().triangles; },
         {&kGrid, &kGridCells}},
        {"triangles", [](const StructureSet& set) -> Triangles { return set.triangles(); }, {}},
        {"leaf_triangles", inTreeLeaves, {}},
        {"boxes", [](const StructureSet& set) -> Triangles { return set.spatialTriangles(); }, {}, true},
    };
    const auto found = std::ranges::find(kStructures, name, &Structure::name);
    if (found == std::end(kStructures)) {
        throw std::logic_error(fmt::format("no structure '{}'", name));
    }
    return *found;
}

std::vector<vk::AabbPositionsKHR> boxesAround(const Lattice& lattice, const Triangles triangles) {
    std::vector<vk::AabbPositionsKHR> boxes(triangles.size());
    std::ranges::transform(triangles, boxes.begin(), [&](const TriangleRecord& triangle) {
        const Box box = boxOf(lattice, triangle);
        const vec3 lo = lowCorner(box);
        const vec3 hi = highCorner(box);
        return vk::AabbPositionsKHR(lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
    });
    return boxes;
}

} // namespace

std::vector<std::string> missingFor(const vulkan::DeviceReport& device, const std::string_view traversal) {
    const auto shader = std::ranges::find(shaders(), traversal, &Shader::traversal);
    const bool inBoxes = shader != shaders().end() && findStructure(shader->structure).inBoxes;
    return inBoxes ? device.missingForRayQuery : std::vector<std::string>();
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
    return device.driver == "llvmpipe" ? Memory::texel : Memory::storage;
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
    for (const StructurePart* const part : structure.parts) {
        if (!parts.contains(part)) {
            parts.emplace(part, upload(device, part->data(*set), part->name));
        }
    }
    if (structure.inBoxes && !boxes) {
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
    for (const StructurePart* const part : structure.parts) {
        if (part->format == vk::Format::eUndefined) {
            own.uniformBindings.push_back(part->binding);
        } else {
            own.texelBindings.emplace(part->binding, part->format);
        }
    }
    for (std::uint32_t i = 0; i < records.buffers.size(); ++i) {
        own.texelBindings.emplace(kBindTriangles + i, kFourWords);
    }
    if (structure.inBoxes) {
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
    for (const StructurePart* const part : structure.parts) {
        pipeline.bind(part->binding, parts.at(part));
    }
    for (std::uint32_t i = 0; i < records.buffers.size(); ++i) {
        pipeline.bind(kBindTriangles + i, records.buffers[i]);
    }
    if (structure.inBoxes) {
        pipeline.bind(kBindBoxes, *boxes);
    }
    return pipeline;
}

std::uint64_t SceneBuffers::bytes() const {
    std::uint64_t total = 0;
    for (const auto& [binding, buffer] : buffers) {
        total += buffer.size();
    }
    for (const auto& [part, buffer] : parts) {
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
