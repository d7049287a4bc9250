// SPDX-License-Identifier: MIT
// Work that exceeds the device's limits is refused by name before the driver sees it.
#include "affine_kernel.h"
#include "fixtures/expect_error.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/submission.h"

#include <gtest/gtest.h>

#include <numeric>

namespace metamarch::vulkan {
namespace {

TEST(DeviceLimits, bufferOverTheAllocationLimit) {
    const uint64_t size = testDevice().report().maxMemoryAllocationSize + 4;
    expectError(ErrorKind::outOfMemory, "buffer 'table'",
                [&] { Buffer(testDevice(), BufferUse::storage, size, "table"); });
}

TEST(DeviceLimits, bindingOverTheRangeLimit) {
    const DeviceReport& report = testDevice().report();
    const uint64_t size = report.maxStorageBufferRange + 4;
    if (size > report.maxMemoryAllocationSize || size > report.deviceLocalHeapSize / 2) {
        ASSERT_NE(report.driver, "llvmpipe") << "its limit can be passed";
        GTEST_SKIP() << "no buffer of this device can pass its range limit";
    }
    const Buffer table(testDevice(), BufferUse::storage, size, "table");
    ComputePipeline pipeline = affineKernel(testDevice(), 1);
    expectError(ErrorKind::outOfMemory, "buffer 'table'", [&] { pipeline.bind(kAffineInputs, table); });
    expectError(ErrorKind::outOfMemory, "maxStorageBufferRange",
                [&] { pipeline.bind(kAffineInputs, table); });
}

TEST(DeviceLimits, moreStorageBuffersThanTheDeviceHas) {
    KernelInfo info = affineInfo();
    info.storageBindings.resize(testDevice().report().maxPerStageDescriptorStorageBuffers + size_t{1});
    std::iota(info.storageBindings.begin(), info.storageBindings.end(), 0u);
    expectError(ErrorKind::noDevice, "kernel 'affine' needs", [&] { ComputePipeline(testDevice(), info); });
}

TEST(DeviceLimits, moreGroupsThanADispatchHolds) {
    const uint32_t most = testDevice().report().maxComputeWorkGroupCount[0];
    if (most == UINT32_MAX) {
        ASSERT_NE(testDevice().report().driver, "llvmpipe") << "its limit can be passed";
        GTEST_SKIP() << "no number passes the limit of this device";
    }
    const ComputePipeline pipeline = affineKernel(testDevice(), 1);
    Submission submission(testDevice());
    expectError(ErrorKind::outOfMemory, "maxComputeWorkGroupCount", [&] {
        submission.run([&](Commands& commands) {
            commands.dispatch(pipeline, {most + 1, 1, 1}, AffinePush{});
        });
    });
}

TEST(DeviceLimits, buffersCountWhatTheyTakeOfTheMemory) {
    constexpr uint64_t kBytes = 1u << 20;
    const auto sum = [] {
        const auto& heaps = testDevice().memoryUse().ofHeap;
        return std::accumulate(heaps.begin(), heaps.end(), uint64_t{0});
    };
    const uint64_t before = sum();
    {
        Buffer table(testDevice(), BufferUse::storage, kBytes, "table");
        EXPECT_GE(sum(), before + kBytes);
        const Buffer moved = std::move(table);
        EXPECT_GE(sum(), before + kBytes);
        EXPECT_LT(sum(), before + 2 * kBytes);
    }
    EXPECT_EQ(sum(), before);
    EXPECT_EQ(testDevice().memoryUse().spilled, 0u);
    EXPECT_GT(testDevice().freeMemory(), 0u);
    EXPECT_LE(testDevice().freeMemory(), testDevice().report().deviceLocalHeapSize);
}

} // namespace
} // namespace metamarch::vulkan
