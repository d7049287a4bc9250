// SPDX-License-Identifier: MIT
// Which traversal goes with which table.
#pragma once
#include "metamarch/accel/options.h"

#include <string_view>

namespace metamarch::render {

// Returns the traversal that marches the tables of `method`.
std::string_view marchingTraversal(TableMethod method);

// Throws Error(invalidArgument) if the traversal does not go with the table. One traversal alone marches the
// rectilinear table, and the others would read a table that was not asked for.
void requireTable(TableMethod method, std::string_view traversal);

} // namespace metamarch::render
