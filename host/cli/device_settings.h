// SPDX-License-Identifier: MIT
// On which device and by which traversal rays are traced.
#pragma once
#include "metamarch/accel/options.h"
#include "metamarch/settings/setting.h"

#include <string>
#include <string_view>
#include <vector>

namespace metamarch::cli {

Setting& declareDevice(SettingList& list, std::string& device);

// A name out of traversals(). Empty: what marches the table.
Setting& declareTraversal(SettingList& list, const std::string& name, std::string& traversal,
                          const std::string& help);

std::vector<std::string> traversalNames();

// The traversal that marches the tables of `method`.
std::string_view marchThrough(TableMethod method);

// Throws Error(invalidArgument) where `traversal` cannot go with the table: the rectilinear table has one
// traversal, and the others would walk what was not asked for.
void requireTable(TableMethod method, std::string_view traversal);

} // namespace metamarch::cli
