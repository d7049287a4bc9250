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

// Returns the traversal of a picture that is made on the CPU: `wanted`, or the fastest if that is empty.
// Paths take the kernel over the meta table or the judge over the kd-tree, `primary` takes the judge. Throws
// Error(invalidArgument) for all other traversals.
std::string traversalOnCpu(bool isPrimary, const std::string& wanted);

} // namespace metamarch::render
