// SPDX-License-Identifier: MIT
#include "fixtures/expect_error.h"
#include "metamarch/vulkan/device_choice.h"

#include <gtest/gtest.h>

#include <vector>

namespace metamarch::vulkan {
namespace {

DeviceReport report(uint32_t index, const char* name, DeviceType type,
                    std::vector<std::string> refusals = {}) {
    DeviceReport result;
    result.index = index;
    result.name = name;
    result.type = type;
    result.refusals = std::move(refusals);
    result.maxPerStageDescriptorStorageBuffers = kMostStorageBuffers;
    result.maxPerStageDescriptorSampledImages = kMostTexelBuffers;
    return result;
}

const std::vector<DeviceReport> kReports = {
    report(0, "llvmpipe", DeviceType::cpu),
    report(1, "Small GPU", DeviceType::integrated),
    report(2, "Old Big GPU", DeviceType::discrete, {"no compute queue"}),
    report(3, "Big GPU", DeviceType::discrete),
    report(4, "Bigger GPU", DeviceType::discrete),
};

TEST(DeviceChoice, takesTheFirstUsableOfTheBestType) {
    EXPECT_EQ(defaultDevice(kReports), 3u);
    EXPECT_EQ(chooseDevice(kReports, ""), 3u);
    EXPECT_EQ(defaultDevice(std::span(kReports).first(1)), 0u);
}

TEST(DeviceChoice, prefersADeviceThatRunsEveryKernel) {
    std::vector<DeviceReport> reports = kReports;
    const auto spoil = [&](const std::size_t i) {
        reports[i].maxPerStageDescriptorStorageBuffers = kMostStorageBuffers - 1;
        EXPECT_TRUE(reports[i].runsEveryKernel()); // through texel buffers
        reports[i].maxPerStageDescriptorSampledImages = kMostTexelBuffers - 1;
        EXPECT_FALSE(reports[i].runsEveryKernel());
    };
    spoil(3);
    EXPECT_EQ(defaultDevice(reports), 4u);
    spoil(4);
    EXPECT_EQ(defaultDevice(reports), 1u);
    spoil(0);
    spoil(1);
    EXPECT_EQ(defaultDevice(reports), 3u); // no device runs all, and this one is the fastest
}

TEST(DeviceChoice, hasNoDefaultAmongUnusableDevices) {
    const std::vector<DeviceReport> reports = {
        report(0, "Old GPU", DeviceType::discrete, {"no compute queue"})};
    EXPECT_EQ(defaultDevice(reports), std::nullopt);
    expectError(ErrorKind::noDevice, "0: Old GPU (not usable: no compute queue)",
                [&] { chooseDevice(reports, ""); });
}

TEST(DeviceChoice, takesDigitsAsAnIndex) {
    EXPECT_EQ(chooseDevice(kReports, "0"), 0u);
    EXPECT_EQ(chooseDevice(kReports, "4"), 4u);
}

TEST(DeviceChoice, refusesAnIndexThatIsNotThere) {
    expectError(ErrorKind::noDevice, "there is no such device", [] { chooseDevice(kReports, "5"); });
    expectError(ErrorKind::noDevice, "there is no such device",
                [] { chooseDevice(kReports, "99999999999999999999"); });
}

TEST(DeviceChoice, refusesAnUnusableDeviceAndSaysWhy) {
    expectError(ErrorKind::noDevice, "no compute queue", [] { chooseDevice(kReports, "2"); });
    expectError(ErrorKind::noDevice, "no compute queue", [] { chooseDevice(kReports, "old"); });
}

TEST(DeviceChoice, takesAPartOfTheNameInAnyCase) {
    EXPECT_EQ(chooseDevice(kReports, "LLVM"), 0u);
    EXPECT_EQ(chooseDevice(kReports, "small gpu"), 1u);
}

TEST(DeviceChoice, overlooksUnusableDevicesByName) { EXPECT_EQ(chooseDevice(kReports, "big gpu"), 3u); }

TEST(DeviceChoice, refusesANameThatFitsSeveral) {
    expectError(ErrorKind::noDevice, "more than one", [] { chooseDevice(kReports, "gpu"); });
}

TEST(DeviceChoice, refusesANameThatFitsNoneAndListsTheDevices) {
    expectError(ErrorKind::noDevice, "1: Small GPU", [] { chooseDevice(kReports, "no such device"); });
    expectError(ErrorKind::noDevice, "fits no usable device", [] { chooseDevice(kReports, "-1"); });
}

} // namespace
} // namespace metamarch::vulkan
