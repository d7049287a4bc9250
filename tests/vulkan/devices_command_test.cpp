// SPDX-License-Identifier: MIT
#include "fixtures/vulkan_environment.h"
#include "metamarch/cli/commands.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace metamarch::cli {
namespace {

// Returns the output of `metamarch devices`, with --json or without.
std::string output(const bool isJson) {
    Command command = makeDevicesCommand();
    if (isJson) {
        command.settings.at("json").set("on");
    }
    testing::internal::CaptureStdout();
    command.run(command.settings);
    return testing::internal::GetCapturedStdout();
}

TEST(DevicesCommand, namesEachDeviceAndMarksOne) {
    const std::string text = output(false);
    for (const vulkan::DeviceReport& report : vulkan::reportDevices(vulkan::testContext())) {
        EXPECT_NE(text.find(report.name), std::string::npos) << text;
    }
    EXPECT_NE(text.find("* "), std::string::npos) << text;
    EXPECT_NE(text.find("maxStorageBufferRange"), std::string::npos) << text;
    EXPECT_NE(text.find("ray queries"), std::string::npos) << text;
}

TEST(DevicesCommand, jsonHasTheLimitsOfTheDefaultDevice) {
    const auto list = nlohmann::json::parse(output(true));
    const vulkan::DeviceReport& expected = vulkan::testDevice().report();
    const auto& device = list.at(expected.index);
    EXPECT_EQ(device.at("name"), expected.name);
    EXPECT_EQ(device.at("default"), true);
    EXPECT_EQ(device.at("refusals"), nlohmann::json::array());
    EXPECT_EQ(device.at("rayQuery"), expected.hasRayQuery());
    EXPECT_EQ(device.at("missingForRayQuery").empty(), expected.hasRayQuery());
    EXPECT_EQ(device.at("maxStorageBufferRange"), expected.maxStorageBufferRange);
    EXPECT_EQ(device.at("roundsToNearestEven"), expected.floatModes.roundsToNearestEven);
    EXPECT_EQ(device.at("keepsSignsInfinitiesAndNans"), expected.floatModes.keepsSignsInfinitiesAndNans);
}

} // namespace
} // namespace metamarch::cli
