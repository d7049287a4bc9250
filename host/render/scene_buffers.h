// SPDX-License-Identifier: MIT
// A scene on the device: the buffers that every kernel reads.
#pragma once
#include "metamarch/accel/structure_set.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shading/shading.h"
#include "metamarch/vulkan/box_hierarchy.h"
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/compute_pipeline.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch::render {

// How the triangle records are cut: bindings hold at most maxStorageBufferRange bytes.
struct TriangleChunks {
    std::uint32_t count;     // 1..kTriangleChunks
    std::uint32_t triangles; // records in each chunk but the last
};

// Texel buffers where they are read faster: on llvmpipe. Elsewhere storage buffers, which every device has
// room in.
Memory fasterMemory(const vulkan::DeviceReport& device);

// The extensions and features that `device` lacks for `traversal`; empty: it can run it.
std::vector<std::string> missingFor(const vulkan::DeviceReport& device, std::string_view traversal);

// Throws Error(noDevice), naming what is missing, where `device` cannot run `traversal`.
void requireTraversal(const vulkan::DeviceReport& device, std::string_view traversal);

// Throws Error(outOfMemory), naming the limit, where kTriangleChunks chunks do not suffice.
TriangleChunks chunkTriangles(std::uint64_t recordCount, std::uint64_t maxStorageBufferRange);

// Lattice, materials and the default traversal's structure go up at once, the structures of others when the
// first pipeline needs them. Must outlive the pipelines it is bound to; `structure` must outlive it.
class SceneBuffers {
  public:
    // Throws Error(outOfMemory) where the scene does not fit the device, naming the limit.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading);

    // The same in storage buffers of at most `maxStorageBufferRange` bytes: for tests, the device having
    // more.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading, std::uint64_t maxStorageBufferRange);

    // The pipeline of `kernel` with `traversal`, empty where the kernel needs none, specialized for this
    // scene and with its buffers bound. `own` holds what the kernel has besides the scene: bindings, which
    // the caller binds, push constants and specialization constants; its texelBindings are those that the
    // shader declares by lib/memory.glsl, whatever memory that is. Its spirv, where there is some, takes the
    // place of the embedded shader: it must be built for memoryKind(). Throws as the constructor does. Not
    // from two threads at a time.
    vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const std::string& kernel,
                                         const std::string& traversal, vulkan::KernelInfo own) const;

    // Which build of a shader its pipelines take.
    Memory memoryKind() const { return memory; }

    std::uint64_t bytes() const; // on the device so far

    // The structures on this side, for the CPU twins.
    const StructureSet& structures() const { return *set; }

  private:
    struct TriangleBuffers {
        TriangleChunks chunks;
        std::vector<vulkan::Buffer> buffers; // kTriangleChunks of them, the last ones empty; of texels one
    };

    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading, Memory usedMemory, std::uint64_t maxStorageBufferRange);

    vulkan::Buffer upload(const vulkan::Device& device, std::span<const std::byte> data,
                          const char* name) const;
    TriangleBuffers uploadTriangles(const vulkan::Device& device,
                                    std::span<const TriangleRecord> records) const;
    void addStructure(const vulkan::Device& device, std::string_view structure) const;

    Memory memory;
    std::uint64_t maxRange; // bytes that a storage binding sees
    std::unique_ptr<StructureSet> set;
    std::map<std::uint32_t, vulkan::Buffer> buffers; // [binding], what every structure has
    // What has been needed so far.
    mutable std::map<const std::byte*, vulkan::Buffer> parts; // [first byte on this side]
    mutable std::optional<vulkan::BoxHierarchy> boxes;
    mutable std::map<const TriangleRecord*, TriangleBuffers> triangles; // [first record], one for each order
};

} // namespace metamarch::render
