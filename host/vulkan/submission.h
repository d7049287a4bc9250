// SPDX-License-Identifier: MIT
// A bounded piece of work for the device: record, submit, wait, time.
#pragma once
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/compute_pipeline.h"
#include "metamarch/vulkan/device.h"
#include "metamarch/vulkan/handle_types.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>

namespace metamarch::vulkan {

using GroupCount = std::array<uint32_t, 3>;

// Records the work of a Submission. Each command sees everything that earlier commands wrote, and the host
// sees everything once it has waited for the submission. The caller needs no barriers.
class Commands {
  public:
    Commands(const Device& device, const vk::raii::CommandBuffer& commandBuffer);

    // Runs `groups` workgroups of a kernel whose bindings are all bound. Throws Error(outOfMemory) if a
    // dispatch cannot hold that many groups.
    void dispatch(const ComputePipeline& pipeline, GroupCount groups) { dispatchBytes(pipeline, groups, {}); }

    // Likewise, for a kernel with push constants; sizeof(T) must be its pushConstantSize.
    template <class T>
    void dispatch(const ComputePipeline& pipeline, GroupCount groups, const T& pushConstants) {
        static_assert(std::is_trivially_copyable_v<T>);
        dispatchBytes(pipeline, groups, std::as_bytes(std::span(&pushConstants, 1)));
    }

    // Copies `size` bytes; offsets are in bytes. A size of 0 does nothing.
    void copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset, uint64_t size);

    // Builds one level of a BoxHierarchy from a geometry with `count` primitives.
    void build(const vk::AccelerationStructureBuildGeometryInfoKHR& info, uint32_t count);

    // Fills the buffer with copies of `word`; its size must be a multiple of 4.
    void fill(const Buffer& buffer, uint32_t word);

  private:
    void dispatchBytes(const ComputePipeline& pipeline, GroupCount groups,
                       std::span<const std::byte> pushConstants);
    void waitForEarlierCommands();

    const Device* device_;
    const vk::raii::CommandBuffer* commandBuffer_;
};

// Reusable, for one piece of work at a time; two Submissions may be in flight together. It can be neither
// copied nor moved, because the device may still be working on it.
class Submission {
  public:
    using Recorder = std::function<void(Commands&)>;

    explicit Submission(const Device& device);
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;
    ~Submission(); // waits if work is in flight

    // Records and submits. Everything that the work uses must stay alive and unmodified until wait() returns.
    void start(const Recorder& record);

    // Returns the seconds that the work took on the device, measured by timestamps. On a queue without them,
    // or where they are equal, it is the wall clock's time since start(), which is also the most that it can
    // be. Throws Error(noDevice) if the device is lost.
    double wait();

    // Calls start() and wait().
    double run(const Recorder& record);

  private:
    struct Handles;

    double deviceSeconds() const;

    const Device* device_;
    std::unique_ptr<Handles> handles_;
    std::chrono::steady_clock::time_point startTime_;
    bool inFlight_ = false;
};

} // namespace metamarch::vulkan
