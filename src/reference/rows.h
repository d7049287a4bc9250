// SPDX-License-Identifier: MIT
// Renders pictures row by row, on all cores.
#pragma once
#include <functional>

namespace metamarch {

// Receives the finished fraction of a picture, which rises to 1. No two calls run at the same time. If it
// returns false, the rest of the picture is cancelled. The function may be empty.
using OnProgress = std::function<bool(double part)>;

// Calls `render` for each of [0, rowCount), from several threads, and `onProgress` after each row. Cancelling
// leaves out the rows that have not begun.
void forEachRow(unsigned rowCount, const std::function<void(unsigned y)>& render,
                const OnProgress& onProgress);

} // namespace metamarch
