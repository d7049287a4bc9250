// SPDX-License-Identifier: MIT
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/device_report.h"

#include <gtest/gtest.h>
#include <vulkan/vulkan_raii.hpp>

#include <algorithm>

namespace metamarch::vulkan {
namespace {

// Returns a device that has exactly what we need.
DeviceReport sufficient() {
    DeviceReport report;
    report.apiVersion = VK_API_VERSION_1_2;
    report.computeQueueFamily = 0;
    report.maxComputeWorkGroupInvocations = 64;
    report.maxComputeWorkGroupSizeX = 64;
    report.maxPerStageDescriptorStorageBuffers = 8;
    report.maxPushConstantsSize = 128;
    return report;
}

TEST(DeviceReport, refusesNothingWithoutAReason) { EXPECT_TRUE(refusalsOf(sufficient()).empty()); }

TEST(DeviceReport, needsNoTimestamps) {
    DeviceReport report = sufficient();
    report.timestampValidBits = 0;
    EXPECT_TRUE(refusalsOf(report).empty());
}

TEST(DeviceReport, namesEveryReason) {
    DeviceReport report = sufficient();
    report.apiVersion = VK_MAKE_API_VERSION(0, 1, 1, 200);
    report.computeQueueFamily.reset();
    report.maxComputeWorkGroupInvocations = 32;
    report.maxPerStageDescriptorStorageBuffers = 4;
    const std::vector<std::string> expected = {
        "Vulkan 1.1, needs 1.2",
        "no compute queue",
        "maxComputeWorkGroupInvocations 32, needs 64",
        "maxPerStageDescriptorStorageBuffers 4, needs 8",
    };
    EXPECT_EQ(refusalsOf(report), expected);
}

TEST(DeviceReport, asksMoreOfAWindowsDevice) {
    DeviceReport report = sufficient();
    report.isForWindow = true;
    report.computeQueueFamily.reset();
    report.hasSwapchain = false;
    const std::vector<std::string> expected = {"no queue that computes, draws and presents to this window",
                                               "no VK_KHR_swapchain, which a window takes"};
    EXPECT_EQ(refusalsOf(report), expected);
}

// The lack of ray queries is no reason to refuse a device, because only one traversal needs them.
TEST(DeviceReport, doesWithoutRayQueries) {
    DeviceReport report = sufficient();
    report.missingForRayQuery = {"VK_KHR_ray_query"};
    EXPECT_FALSE(report.hasRayQuery());
    EXPECT_TRUE(report.usable());
    EXPECT_TRUE(refusalsOf(report).empty());
}

TEST(DeviceReport, describesTheDevicesOfThisMachine) {
    const std::vector<DeviceReport> reports = reportDevices(testContext());
    ASSERT_EQ(reports.size(), testContext().physicalDevices().size());
    for (uint32_t index = 0; index < reports.size(); ++index) {
        EXPECT_EQ(reports[index].index, index);
        EXPECT_FALSE(reports[index].name.empty());
    }
}

// A device whose queues draw, but do not present to the window, is refused before it is opened.
TEST(DeviceReport, refusesDevicesThatDoNotPresent) {
    const auto reports = reportDevices(testContext(), [](VkPhysicalDevice, uint32_t) { return false; });
    ASSERT_FALSE(reports.empty());
    for (const DeviceReport& report : reports) {
        EXPECT_TRUE(report.isForWindow);
        EXPECT_FALSE(report.computeQueueFamily);
        EXPECT_NE(
            std::ranges::find(report.refusals, "no queue that computes, draws and presents to this window"),
            report.refusals.end())
            << report.name;
    }
}

TEST(DeviceReport, presentsWithAQueueThatIsOffered) {
    std::vector<uint32_t> asked;
    const auto reports = reportDevices(testContext(), [&](VkPhysicalDevice, const uint32_t family) {
        asked.push_back(family);
        return true;
    });
    ASSERT_FALSE(asked.empty());
    const auto& report = reports.at(testDevice().report().index);
    if (report.computeQueueFamily) { // a device for computing alone draws nothing
        EXPECT_NE(std::ranges::find(asked, *report.computeQueueFamily), asked.end());
    }
}

TEST(DeviceReport, readsTheLimitsOfTheOpenedDevice) {
    const DeviceReport& report = testDevice().report();
    EXPECT_FALSE(report.driver.empty());
    EXPECT_GE(report.maxStorageBufferRange, uint64_t{1} << 27); // the minimum that Vulkan guarantees
    EXPECT_GE(report.maxMemoryAllocationSize, uint64_t{1} << 30);
    EXPECT_GE(report.maxComputeWorkGroupCount[0], 65535u);
    EXPECT_GT(report.deviceLocalHeapSize, 0u);
    EXPECT_GT(report.subgroupSize, 0u);
}

} // namespace
} // namespace metamarch::vulkan
