// A scene on the device: the buffers that every kernel reads.
#pragma once
#include "accel/structure_set.h"
#include "scene/shading.h"
#include "vulkan/buffer.h"
#include "vulkan/compute_pipeline.h"

#include <cstdint>
#include <map>
#include <memory>
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

// The orders that triangle records lie in, one copy on the device for each in use.
enum class TriangleOrder { kdLeaves, bvhLeaves, gridCells, ascending };

// Throws Error(outOfMemory), naming the limit, where kTriangleChunks chunks do not suffice.
TriangleChunks chunkTriangles(std::uint64_t recordCount, std::uint64_t maxStorageBufferRange);

// Lattice, materials and the default traversal's structure go up at once, the structures of others when the
// first pipeline needs them. Must outlive the pipelines it is bound to; `structure` must outlive it.
class SceneBuffers {
  public:
    // Throws Error(outOfMemory) where the scene does not fit the device, naming the limit.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading);

    // The same with at most `maxStorageBufferRange` bytes in a buffer: for tests, the device having more.
    SceneBuffers(const vulkan::Device& device, const AccelerationStructure& structure,
                 const ShadingData& shading, std::uint64_t maxStorageBufferRange);

    // The pipeline of `kernel` with `traversal`, specialized for this scene and with its buffers bound.
    // `own` holds what the kernel has besides the scene: bindings, which the caller binds, push constants and
    // specialization constants. Throws as the constructor does. Not from two threads at a time.
    vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const std::string& kernel,
                                         const std::string& traversal, vulkan::KernelInfo own) const;

    std::uint64_t bytes() const; // on the device so far

    // The structures on this side, for the CPU twins.
    const StructureSet& structures() const { return *set; }

  private:
    struct TriangleBuffers {
        TriangleChunks chunks;
        std::vector<vulkan::Buffer> buffers; // kTriangleChunks of them, the last ones empty
    };

    vulkan::Buffer upload(const vulkan::Device& device, std::span<const std::byte> data,
                          const char* name) const;
    void add(const vulkan::Device& device, std::uint32_t binding, std::span<const std::byte> data,
             const char* name) const;
    void addStructure(const vulkan::Device& device, std::string_view structure) const;

    std::uint64_t maxRange;
    std::unique_ptr<StructureSet> set;
    // What has been needed so far.
    mutable std::map<std::uint32_t, vulkan::Buffer> buffers; // [binding], but for triangles
    mutable std::map<TriangleOrder, TriangleBuffers> triangles;
};

} // namespace metamarch::render
