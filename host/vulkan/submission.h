// One bounded piece of work for the device: recorded, submitted, waited for, timed.
#pragma once
#include "metamarch/vulkan/buffer.h"
#include "metamarch/vulkan/compute_pipeline.h"
#include "metamarch/vulkan/device.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>

namespace metamarch::vulkan {

using GroupCount = std::array<uint32_t, 3>;

// What a Submission's recorder writes its work with. Each command sees everything that the commands before it
// wrote, and the host sees everything once the submission has been waited for: there is no barrier to forget.
class Commands {
  public:
    Commands(const Device& device, const vk::raii::CommandBuffer& commandBuffer);

    // Runs `groups` workgroups of a kernel all of whose bindings are bound.
    // Throws Error(outOfMemory) for more groups than one dispatch can hold.
    void dispatch(const ComputePipeline& pipeline, GroupCount groups) { dispatchBytes(pipeline, groups, {}); }

    // The same for a kernel with push constants; sizeof(T) is its pushConstantSize.
    template <class T>
    void dispatch(const ComputePipeline& pipeline, GroupCount groups, const T& pushConstants) {
        static_assert(std::is_trivially_copyable_v<T>);
        dispatchBytes(pipeline, groups, std::as_bytes(std::span(&pushConstants, 1)));
    }

    // Copies `size` bytes; offsets in bytes. A size of 0 does nothing.
    void copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset, uint64_t size);

    // Builds one of the levels of a BoxHierarchy, of one geometry with `count` primitives.
    void build(const vk::AccelerationStructureBuildGeometryInfoKHR& info, uint32_t count);

    // Fills the buffer, whose size is a multiple of 4, with copies of `word`.
    void fill(const Buffer& buffer, uint32_t word);

  private:
    void dispatchBytes(const ComputePipeline& pipeline, GroupCount groups,
                       std::span<const std::byte> pushConstants);
    void waitForEarlierCommands();

    const Device* device_;
    const vk::raii::CommandBuffer* commandBuffer_;
};

// Reusable, one piece of work at a time; two Submissions can be in flight together. It neither copies nor
// moves, because the device may still be working on it.
class Submission {
  public:
    using Recorder = std::function<void(Commands&)>;

    explicit Submission(const Device& device);
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;
    ~Submission(); // waits for work still in flight

    // Records and submits. What it uses must stay alive and untouched until wait() returns.
    void start(const Recorder& record);

    // Returns the seconds the work took on the device: by its timestamps, or by the wall clock from start()
    // on a queue without them. Throws Error(noDevice) when the device is lost or does not end in kTimeout.
    double wait();

    // start() and wait().
    double run(const Recorder& record);

    // Far beyond the 50 to 100 ms of work a submission should hold; lavapipe may compile for seconds first.
    static constexpr std::chrono::minutes kTimeout{5};

  private:
    double deviceSeconds() const;

    const Device* device_;
    vk::raii::CommandBuffer commandBuffer_;
    vk::raii::Fence fence_;
    vk::raii::QueryPool timestamps_ = nullptr; // null on a queue without timestamps
    std::chrono::steady_clock::time_point startTime_;
    bool inFlight_ = false;
};

} // namespace metamarch::vulkan
