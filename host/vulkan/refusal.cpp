// SPDX-License-Identifier: MIT
#include "metamarch/vulkan/refusal.h"

#include <fmt/format.h>
#include <vulkan/vulkan.hpp>

#include <fstream>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>

namespace metamarch::vulkan {
namespace {

constexpr double kMebibyte = 0x1p20;

// In bytes.
std::optional<double> addressLimit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return std::nullopt;
    }
    return static_cast<double>(limit.rlim_cur);
}

double usedAddresses() {
    double pages = 0.0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

} // namespace

Error refusalOf(const vk::SystemError& error, const std::string& what) {
    const bool memory = error.code() == vk::Result::eErrorOutOfDeviceMemory ||
                        error.code() == vk::Result::eErrorOutOfHostMemory;
    return {memory ? ErrorKind::outOfMemory : ErrorKind::noDevice,
            fmt::format("{} ({}){}", what, error.what(), addressLimitText())};
}

std::optional<Error> refusalOf(const std::system_error& error, const std::string& what) {
    const auto* const vulkan = dynamic_cast<const vk::SystemError*>(&error);
    return vulkan == nullptr ? std::nullopt : std::optional(refusalOf(*vulkan, what));
}

std::string addressLimitText() {
    const std::optional<double> limit = addressLimit();
    return limit ? fmt::format("; the process may take {:.0f} MiB of addresses (`ulimit -v`)",
                               *limit / kMebibyte)
                 : "";
}

void checkAddressLimit() {
    constexpr double kLeast = 1200.0 * kMebibyte; // llvmpipe on two processors
    const std::optional<double> limit = addressLimit();
    if (limit && *limit - usedAddresses() < kLeast) {
        throw Error(
            ErrorKind::outOfMemory,
            fmt::format("a Vulkan driver needs {:.0f} MiB of addresses more than the {:.0f} MiB in use{}",
                        kLeast / kMebibyte, usedAddresses() / kMebibyte, addressLimitText()));
    }
}

} // namespace metamarch::vulkan
