// SPDX-License-Identifier: MIT
// The settings that choose the device and the traversal.
#pragma once
#include "metamarch/settings/setting.h"

#include <string>
#include <vector>

namespace metamarch::cli {

Setting& declareDevice(SettingList& list, std::string& device);

// Declares a setting for a name of traversals(). An empty name means the traversal that marches the table.
Setting& declareTraversal(SettingList& list, const std::string& name, std::string& traversal,
                          const std::string& help);

std::vector<std::string> traversalNames();

} // namespace metamarch::cli
