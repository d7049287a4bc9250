// SPDX-License-Identifier: MIT
#include "metamarch/cli/device_settings.h"

#include "metamarch/shaders/shader_library.h"

namespace metamarch::cli {

Setting& declareDevice(SettingList& list, std::string& device) {
    return list.text("device", device, "Vulkan device, see `metamarch devices`").withValueName("INDEX|NAME");
}

Setting& declareTraversal(SettingList& list, const std::string& name, std::string& traversal,
                          const std::string& help) {
    return list.word(name, traversal, traversalNames(), help).withValueName("NAME");
}

std::vector<std::string> traversalNames() { return {traversals().begin(), traversals().end()}; }

} // namespace metamarch::cli
