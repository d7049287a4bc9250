// SPDX-License-Identifier: MIT
// Which traversal goes with which table.
#pragma once
#include "metamarch/accel/options.h"

#include <string>
#include <string_view>

namespace metamarch::render {

// Returns the traversal that marches the tables of `method`.
std::string_view marchingTraversal(TableMethod method);

// Throws Error(invalidArgument) if the traversal does not go with the table. One traversal alone marches the
// rectilinear table, and the others would read a table that was not asked for.
void requireTable(TableMethod method, std::string_view traversal);

// Returns whether the CPU has this traversal: the kernels' or the judge's.
bool isOnCpu(std::string_view traversal);

// Returns the traversal of a picture that is made on the CPU: `wanted`, or that of the kernels, over the meta
// table, if it is empty. The judge takes kd_stack. Throws Error(invalidArgument) for all other traversals.
std::string traversalOnCpu(const std::string& wanted);

} // namespace metamarch::render
