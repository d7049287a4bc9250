// SPDX-License-Identifier: MIT
// The buffers of a scene on the device that every kernel reads.
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

// How the triangle records are cut into chunks, because a binding holds at most maxStorageBufferRange bytes.
struct TriangleChunks {
    std::uint32_t count;     // 1..kTriangleChunks
    std::uint32_t triangles; // number of records in each chunk but the last
};

// Returns texel buffers on llvmpipe, which reads them faster, and where a device has too few storage buffers.
// Otherwise returns storage buffers, which are large enough on every device.
Memory fasterMemory(const vulkan::DeviceReport& device);

// Returns the extensions and features that `device` lacks for `traversal`; an empty list means that the
// device can run it.
std::vector<std::string> missingFor(const vulkan::DeviceReport& device, std::string_view traversal);

// Throws Error(noDevice), naming what is missing, if `device` cannot run `traversal`.
void requireTraversal(const vulkan::DeviceReport& device, std::string_view traversal);

// Throws Error(outOfMemory), naming the limit, if kTriangleChunks chunks do not suffice.
TriangleChunks chunkTriangles(std::uint64_t recordCount, std::uint64_t maxStorageBufferRange);

// The constructor uploads the lattice, the materials and the structure of the default traversal. makePipeline
// uploads other structures when a pipeline first needs them. SceneBuffers must outlive these pipelines, and
// `structure` must outlive SceneBuffers.
class SceneBuffers {
  public:
    // Throws Error(outOfMemory), naming the limit, if the scene does not fit the device.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading);

    // For tests: always uses storage buffers, of at most `maxStorageBufferRange` bytes. The device's own
    // limit must not be lower.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading, std::uint64_t maxStorageBufferRange);

    // Returns the pipeline of `kernel` with `traversal`, specialized for this scene, with the scene's buffers
    // bound. `traversal` is empty if the kernel needs none. `own` describes what the kernel has besides the
    // scene: bindings, which the caller binds, push constants and specialization constants. Its texelBindings
    // are the buffers that the shader declares by the macros of lib/memory.glsl, for either kind of memory.
    // If its spirv is not empty, it replaces the embedded shader and must be built for memoryKind(). Throws
    // as the constructor does, and as requireTraversal. Call it from one thread at a time.
    vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const std::string& kernel,
                                         const std::string& traversal, vulkan::KernelInfo own) const;

    // The kind of memory that its pipelines' shaders must be built for.
    Memory memoryKind() const { return memory; }

    std::uint64_t bytes() const; // device memory in use; grows when makePipeline uploads a structure

    // The structures in host memory, for the CPU twins.
    const StructureSet& structures() const { return *set; }

  private:
    struct TriangleBuffers {
        TriangleChunks chunks;
        // Storage memory: kTriangleChunks buffers, of which the last ones may be empty. Texel memory: one.
        std::vector<vulkan::Buffer> buffers;
    };

    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading, Memory usedMemory, std::uint64_t maxStorageBufferRange);

    vulkan::Buffer upload(const vulkan::Device& device, std::span<const std::byte> data,
                          const char* name) const;
    TriangleBuffers uploadTriangles(const vulkan::Device& device,
                                    std::span<const TriangleRecord> records) const;
    void addStructure(const vulkan::Device& device, std::string_view structure) const;

    Memory memory;
    std::uint64_t maxRange; // bytes that a storage binding can see
    std::unique_ptr<StructureSet> set;
    std::map<std::uint32_t, vulkan::Buffer> buffers; // [binding]; every kernel reads them
    // Uploaded when first needed.
    mutable std::map<const std::byte*, vulkan::Buffer> parts; // [first byte in host memory]
    mutable std::optional<vulkan::BoxHierarchy> boxes;
    mutable std::map<const TriangleRecord*, TriangleBuffers> triangles; // [first record in host memory]
};

} // namespace metamarch::render
