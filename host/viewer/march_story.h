// SPDX-License-Identifier: MIT
// What the march and the stack traversal do with one ray, in words.
#pragma once
#include "metamarch/reference/march_log.h"
#include "metamarch/reference/walk_log.h"

#include <cstddef>
#include <string>

namespace metamarch::viewer {

// Tells a step of the march: the cell, what the table says about it, and where the ray goes. `step` is an
// index.
std::string sentenceOf(const MarchLog& march, std::size_t step);

// Tells a visit of the stack traversal. `visit` is an index.
std::string sentenceOf(const WalkLog& walk, std::size_t visit);

// Returns how many visits the stack traversal needs to get as far along the ray as the march with its `step`,
// an index.
std::size_t visitsUpTo(const WalkLog& walk, const MarchLog& march, std::size_t step);

} // namespace metamarch::viewer
