// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/device_choice.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <utility>

namespace metamarch::vulkan {
namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Returns a text such as "0: llvmpipe (LLVM 15.0.6, 256 bits); 1: Old GPU (not usable: no compute queue)".
std::string listText(std::span<const DeviceReport> reports) {
    std::string list;
    for (const DeviceReport& report : reports) {
        fmt::format_to(std::back_inserter(list), "{}{}: {}", list.empty() ? "" : "; ", report.index,
                       report.name);
        if (!report.usable()) {
            fmt::format_to(std::back_inserter(list), " (not usable: {})", fmt::join(report.refusals, ", "));
        }
    }
    return list;
}

[[noreturn]] void refuse(const std::string& what, std::span<const DeviceReport> reports) {
    throw Error(ErrorKind::noDevice, fmt::format("{}; devices: {}", what, listText(reports)), {"device"});
}

uint32_t chooseByIndex(std::span<const DeviceReport> reports, const std::string& digits) {
    uint32_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || index >= reports.size()) {
        refuse(fmt::format("device {}: there is no such device", digits), reports);
    }
    if (!reports[index].usable()) {
        refuse(fmt::format("device {}: this device is not usable", digits), reports);
    }
    return index;
}

uint32_t chooseByName(std::span<const DeviceReport> reports, const std::string& part) {
    std::optional<uint32_t> found;
    for (const DeviceReport& report : reports) {
        if (!report.usable() || lowerCase(report.name).find(lowerCase(part)) == std::string::npos) {
            continue;
        }
        if (found) {
            refuse(fmt::format("device '{}': fits more than one device, give the index", part), reports);
        }
        found = report.index;
    }
    if (!found) {
        refuse(fmt::format("device '{}': fits no usable device", part), reports);
    }
    return *found;
}

} // namespace

std::optional<uint32_t> defaultDevice(std::span<const DeviceReport> reports) {
    const DeviceReport* best = nullptr;
    for (const DeviceReport& report : reports) {
        // DeviceType is in order of preference.
        const auto rank = [](const DeviceReport& device) {
            return std::pair(!device.runsEveryKernel(), device.type);
        };
        if (report.usable() && (best == nullptr || rank(report) < rank(*best))) {
            best = &report;
        }
    }
    return best == nullptr ? std::nullopt : std::optional(best->index);
}

uint32_t chooseDevice(std::span<const DeviceReport> reports, const std::string& selection) {
    if (selection.empty()) {
        const std::optional<uint32_t> index = defaultDevice(reports);
        if (!index) {
            refuse("no usable Vulkan device", reports);
        }
        return *index;
    }
    const bool onlyDigits =
        std::all_of(selection.begin(), selection.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    return onlyDigits ? chooseByIndex(reports, selection) : chooseByName(reports, selection);
}

} // namespace metamarch::vulkan
