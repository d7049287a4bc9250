// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/submission.h"

#include "metamarch/error/error.h"
#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace metamarch::vulkan {
namespace {

using Access = vk::AccessFlagBits;
using Stage = vk::PipelineStageFlagBits;

constexpr vk::PipelineStageFlags kWorkStages = Stage::eComputeShader | Stage::eTransfer;
constexpr vk::AccessFlags kWorkWrites = Access::eShaderWrite | Access::eTransferWrite;
constexpr vk::AccessFlags kWorkReads = Access::eShaderRead | Access::eUniformRead | Access::eTransferRead;

// Hierarchies are built in a separate pipeline stage, which exists only on devices with ray queries.
vk::PipelineStageFlags workStages(const Device& device) {
    return device.report().hasRayQuery() ? kWorkStages | Stage::eAccelerationStructureBuildKHR : kWorkStages;
}
vk::AccessFlags workWrites(const Device& device) {
    return device.report().hasRayQuery() ? kWorkWrites | Access::eAccelerationStructureWriteKHR : kWorkWrites;
}
vk::AccessFlags workReads(const Device& device) {
    return device.report().hasRayQuery() ? kWorkReads | Access::eAccelerationStructureReadKHR : kWorkReads;
}

vk::raii::CommandBuffer allocateCommandBuffer(const Device& device) {
    vk::raii::CommandBuffers buffers(device.handle(),
                                     {*device.commandPool(), vk::CommandBufferLevel::ePrimary, 1});
    return std::move(buffers.front());
}

} // namespace

Commands::Commands(const Device& device, const vk::raii::CommandBuffer& commandBuffer)
    : device_(&device), commandBuffer_(&commandBuffer) {}

// A single barrier over all memory: the stages of a renderer depend on each other anyway, and drivers do not
// exploit finer barriers. It also precedes the first command, to order it after earlier submissions.
void Commands::waitForEarlierCommands() {
    const vk::MemoryBarrier barrier(workWrites(*device_), workReads(*device_) | workWrites(*device_));
    commandBuffer_->pipelineBarrier(workStages(*device_), workStages(*device_), {}, barrier, {}, {});
}

void Commands::dispatchBytes(const ComputePipeline& pipeline, GroupCount groups,
                             std::span<const std::byte> pushConstants) {
    if (pushConstants.size() != pipeline.pushConstantSize()) {
        throw std::logic_error(fmt::format("kernel '{}' takes {} bytes of push constants, not {}",
                                           pipeline.name(), pipeline.pushConstantSize(),
                                           pushConstants.size()));
    }
    const GroupCount& most = device_->report().maxComputeWorkGroupCount;
    if (groups[0] > most[0] || groups[1] > most[1] || groups[2] > most[2]) {
        throw Error(ErrorKind::outOfMemory,
                    fmt::format("{}: kernel '{}': {} workgroups are over maxComputeWorkGroupCount, {}",
                                device_->name(), pipeline.name(), fmt::join(groups, " x "),
                                fmt::join(most, " x ")));
    }
    waitForEarlierCommands();
    commandBuffer_->bindPipeline(vk::PipelineBindPoint::eCompute, pipeline.handle());
    commandBuffer_->bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipeline.layout(), 0,
                                       pipeline.descriptorSet(), {});
    if (!pushConstants.empty()) {
        commandBuffer_->pushConstants<std::byte>(
            pipeline.layout(), vk::ShaderStageFlagBits::eCompute, 0,
            {static_cast<uint32_t>(pushConstants.size()), pushConstants.data()});
    }
    commandBuffer_->dispatch(groups[0], groups[1], groups[2]);
}

void Commands::copy(const Buffer& from, uint64_t fromOffset, const Buffer& to, uint64_t toOffset,
                    uint64_t size) {
    if (size == 0) {
        return; // Vulkan forbids empty copies
    }
    waitForEarlierCommands();
    commandBuffer_->copyBuffer(from.handle(), to.handle(), vk::BufferCopy(fromOffset, toOffset, size));
}

void Commands::build(const vk::AccelerationStructureBuildGeometryInfoKHR& info, uint32_t count) {
    waitForEarlierCommands();
    const vk::AccelerationStructureBuildRangeInfoKHR range(count);
    commandBuffer_->buildAccelerationStructuresKHR(info, &range);
}

void Commands::fill(const Buffer& buffer, uint32_t word) {
    if (buffer.size() == 0) {
        return; // nothing in it can be read
    }
    waitForEarlierCommands();
    commandBuffer_->fillBuffer(buffer.handle(), 0, buffer.size(), word);
}

struct Submission::Handles {
    explicit Handles(const Device& device)
        : commandBuffer(allocateCommandBuffer(device)), fence(device.handle(), vk::FenceCreateInfo()) {}

    vk::raii::CommandBuffer commandBuffer;
    vk::raii::Fence fence;
    vk::raii::QueryPool timestamps = nullptr; // null on a queue without timestamps
};

Submission::Submission(const Device& device) : device_(&device), handles_(std::make_unique<Handles>(device)) {
    if (device.timestampPeriod() > 0) {
        handles_->timestamps = {device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2)};
    }
}

Submission::~Submission() {
    if (!inFlight_) {
        return;
    }
    try {
        wait();
    } catch (const std::exception&) {
        // The device is lost. Its next user gets an error.
    }
}

void Submission::start(const Recorder& record) {
    if (inFlight_) {
        throw std::logic_error("Submission::start: the work before has not been waited for");
    }
    const vk::raii::CommandBuffer& commandBuffer = handles_->commandBuffer;
    const vk::raii::QueryPool& timestamps = handles_->timestamps;
    try {
        commandBuffer.reset(); // it may be partly recorded, because a recorder may throw
        commandBuffer.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        const bool timed = *timestamps;
        if (timed) {
            commandBuffer.resetQueryPool(*timestamps, 0, 2);
            // At the bottom of the pipe, earlier submissions are over, and their time does not count.
            commandBuffer.writeTimestamp(Stage::eBottomOfPipe, *timestamps, 0);
        }
        Commands commands(*device_, commandBuffer);
        record(commands);
        if (timed) {
            commandBuffer.writeTimestamp(Stage::eBottomOfPipe, *timestamps, 1);
        }
        const vk::MemoryBarrier toHost(kWorkWrites, Access::eHostRead);
        commandBuffer.pipelineBarrier(kWorkStages, Stage::eHost, {}, toHost, {}, {});
        commandBuffer.end();

        device_->handle().resetFences(*handles_->fence);
        startTime_ = std::chrono::steady_clock::now();
        device_->queue().submit(vk::SubmitInfo({}, {}, *commandBuffer), *handles_->fence);
        inFlight_ = true;
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: cannot submit work", device_->name()));
    }
}

double Submission::wait() {
    if (!inFlight_) {
        throw std::logic_error("Submission::wait: nothing was started");
    }
    inFlight_ = false; // even if the device is lost: another wait would not help
    try {
        // Waits as long as it takes: giving up would free memory that the device still writes to. A device
        // that hangs is reset by its driver, and then it is lost.
        constexpr uint64_t kForever = std::numeric_limits<uint64_t>::max();
        if (device_->handle().waitForFences(*handles_->fence, VK_TRUE, kForever) != vk::Result::eSuccess) {
            throw Error(ErrorKind::noDevice, fmt::format("{}: device lost", device_->name()));
        }
        return deviceSeconds();
    } catch (const vk::SystemError& error) {
        throw refusalOf(error, fmt::format("{}: device lost", device_->name()));
    }
}

double Submission::run(const Recorder& record) {
    start(record);
    return wait();
}

double Submission::deviceSeconds() const {
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - startTime_).count();
    if (!*handles_->timestamps) {
        return wall;
    }
    const auto [result, ticks] = handles_->timestamps.getResults<uint64_t>(
        0, 2, 2 * sizeof(uint64_t), sizeof(uint64_t),
        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    // A counter with n bits wraps at 2^n.
    const uint32_t unusedBits = 64 - device_->report().timestampValidBits;
    const uint64_t elapsed = ((ticks[1] - ticks[0]) << unusedBits) >> unusedBits;
    // Some clocks tick so slowly that both stamps are equal, and a clock that stood still says nothing.
    const double seconds = static_cast<double>(elapsed) * device_->timestampPeriod() * 1e-9;
    return elapsed == 0 ? wall : std::min(seconds, wall);
}

} // namespace metamarch::vulkan
