// SPDX-License-Identifier: MIT
#include "metamarch/cli/commands.h"
#include "metamarch/error/error.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/vulkan/byte_text.h"
#include "metamarch/vulkan/device_choice.h"
#include "metamarch/vulkan/device_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::cli {
namespace {

using vulkan::DeviceReport;

void printLine(const char* what, const std::string& value) {
    printResult(fmt::format("     {:<36} {}\n", what, value));
}

std::string usableText(const DeviceReport& report, bool isDefault) {
    if (!report.usable()) {
        return fmt::format("no: {}", fmt::join(report.refusals, "; "));
    }
    if (!report.runsEveryKernel()) {
        return fmt::format("in part: some kernels take {} storage buffers or {} texel buffers",
                           vulkan::kMostStorageBuffers, vulkan::kMostTexelBuffers);
    }
    return isDefault ? "yes, used unless --device says otherwise" : "yes";
}

std::string timestampText(const DeviceReport& report) {
    if (report.timestampValidBits == 0) {
        return "none (not needed: times are taken by the wall clock)";
    }
    return fmt::format("{} bits, {} ns per tick", report.timestampValidBits, report.timestampPeriod);
}

std::string rayQueryText(const DeviceReport& report) {
    return report.hasRayQuery() ? "yes"
                                : fmt::format("no (only --traversal ray_query needs them): {}",
                                              fmt::join(report.missingForRayQuery, ", "));
}

std::string floatModesText(const vulkan::FloatModes& modes) {
    return fmt::format("{}, {}", modes.roundsToNearestEven ? "rounds to nearest even" : "may round anyhow",
                       modes.keepsSignsInfinitiesAndNans ? "keeps -0, infinities and NaN"
                                                         : "may lose -0, infinities and NaN");
}

void printReport(const DeviceReport& report, bool isDefault) {
    printResult(fmt::format("{} {}  {}\n", isDefault ? "*" : " ", report.index, report.name));
    printLine("usable", usableText(report, isDefault));
    printLine("type", typeText(report.type));
    printLine("driver", fmt::format("{} {}", report.driver, report.driverInfo));
    printLine("Vulkan", vulkan::versionText(report.apiVersion));
    printLine("largest device-local heap", vulkan::byteText(report.deviceLocalHeapSize));
    printLine("maxMemoryAllocationSize", vulkan::byteText(report.maxMemoryAllocationSize));
    printLine("maxStorageBufferRange", vulkan::byteText(report.maxStorageBufferRange));
    printLine("maxTexelBufferElements", fmt::to_string(report.maxTexelBufferElements));
    printLine("maxPerStageDescriptorStorageBuffers",
              fmt::to_string(report.maxPerStageDescriptorStorageBuffers));
    printLine("maxPerStageDescriptorSampledImages",
              fmt::to_string(report.maxPerStageDescriptorSampledImages));
    printLine("maxPushConstantsSize", vulkan::byteText(report.maxPushConstantsSize));
    printLine("maxComputeWorkGroupInvocations", fmt::to_string(report.maxComputeWorkGroupInvocations));
    printLine("maxComputeWorkGroupSize[0]", fmt::to_string(report.maxComputeWorkGroupSizeX));
    printLine("maxComputeWorkGroupCount[0]", fmt::to_string(report.maxComputeWorkGroupCount[0]));
    printLine("subgroup size", fmt::to_string(report.subgroupSize));
    printLine("floats", floatModesText(report.floatModes));
    printLine("timestamps", timestampText(report));
    printLine("ray queries", rayQueryText(report));
}

// Sizes are in bytes.
nlohmann::ordered_json toJson(const DeviceReport& report, bool isDefault) {
    return {{"index", report.index},
            {"name", report.name},
            {"default", isDefault},
            {"usable", report.usable()},
            {"refusals", report.refusals},
            {"type", typeText(report.type)},
            {"driver", report.driver},
            {"driverInfo", report.driverInfo},
            {"apiVersion", vulkan::versionText(report.apiVersion)},
            {"deviceLocalHeapSize", report.deviceLocalHeapSize},
            {"maxMemoryAllocationSize", report.maxMemoryAllocationSize},
            {"maxStorageBufferRange", report.maxStorageBufferRange},
            {"maxTexelBufferElements", report.maxTexelBufferElements},
            {"maxPerStageDescriptorStorageBuffers", report.maxPerStageDescriptorStorageBuffers},
            {"maxPerStageDescriptorSampledImages", report.maxPerStageDescriptorSampledImages},
            {"maxPushConstantsSize", report.maxPushConstantsSize},
            {"maxComputeWorkGroupInvocations", report.maxComputeWorkGroupInvocations},
            {"maxComputeWorkGroupSizeX", report.maxComputeWorkGroupSizeX},
            {"maxComputeWorkGroupCount", report.maxComputeWorkGroupCount},
            {"subgroupSize", report.subgroupSize},
            {"roundsToNearestEven", report.floatModes.roundsToNearestEven},
            {"keepsSignsInfinitiesAndNans", report.floatModes.keepsSignsInfinitiesAndNans},
            {"timestampValidBits", report.timestampValidBits},
            {"timestampPeriod", report.timestampPeriod},
            {"rayQuery", report.hasRayQuery()},
            {"missingForRayQuery", report.missingForRayQuery}};
}

void runDevices(bool json) {
    const vulkan::Context context;
    const std::vector<DeviceReport> reports = vulkan::reportDevices(context);
    const std::optional<uint32_t> defaultIndex = vulkan::defaultDevice(reports);

    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceReport& report : reports) {
        const bool isDefault = report.index == defaultIndex;
        if (json) {
            list.push_back(toJson(report, isDefault));
        } else {
            printReport(report, isDefault);
        }
    }
    if (json) { // a driver may call its device by bytes that are no UTF-8
        printResult(
            fmt::format("{}\n", list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
    }
    // SwiftShader flushes every stream when it is unloaded, and tells nobody whether that failed.
    flushResults();
    if (!defaultIndex) {
        throw Error(ErrorKind::noDevice, "no usable Vulkan device; the list above says why");
    }
}

} // namespace

Command makeDevicesCommand() {
    const auto json = std::make_shared<bool>(false);
    Command command{"devices", "List the Vulkan devices and what they lack", {}, {}, {}, {}};
    command.settings.flag("json", *json, "Print the list as JSON; sizes are bytes");
    command.footer =
        "The device marked * is used unless --device names another by its index or a part of its\n"
        "name. Exit code: 0 with a usable device, 4 without one.\n\n"
        "Example:\n"
        "  build/metamarch devices";
    command.run = [json](const SettingList&) { runDevices(*json); };
    return command;
}

} // namespace metamarch::cli
