// A scene on the device: the buffers that every kernel reads.
#pragma once
#include "accel/acceleration_structure.h"
#include "scene/shading.h"
#include "vulkan/buffer.h"
#include "vulkan/compute_pipeline.h"

#include <cstdint>
#include <string>
#include <vector>

namespace metamarch::render {

// How the triangle records are cut: bindings hold at most maxStorageBufferRange bytes.
struct TriangleChunks {
    std::uint32_t count;     // 1..kTriangleChunks
    std::uint32_t triangles; // records in each chunk but the last
};

// Throws Error(outOfMemory), naming the limit, where kTriangleChunks chunks do not suffice.
TriangleChunks chunkTriangles(std::uint64_t recordCount, std::uint64_t maxStorageBufferRange);

// Must outlive the pipelines it is bound to.
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
    // specialization constants.
    vulkan::ComputePipeline makePipeline(const vulkan::Device& device, const std::string& kernel,
                                         const std::string& traversal, vulkan::KernelInfo own) const;

    std::uint64_t bytes() const; // on the device

  private:
    TriangleChunks chunks;
    std::vector<vulkan::Buffer> buffers; // [binding]; empty ones where kernels bind their own
    std::vector<std::uint32_t> bindings; // of `buffers`
};

} // namespace metamarch::render
