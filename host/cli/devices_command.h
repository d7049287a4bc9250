#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

// metamarch devices: every Vulkan device with the limits we depend on, or the reasons why it is refused.
void addDevicesCommand(CLI::App& program);

} // namespace metamarch::cli
