// SPDX-License-Identifier: MIT
// Pictures row by row, on all cores.
#pragma once
#include <functional>

namespace metamarch {

// Receives the finished part of a picture. The part rises to 1, and no two calls run at the same time. To
// return false cancels the rest of the picture. The function may be empty.
using OnProgress = std::function<bool(double part)>;

// Calls `render` for each of [0, rowCount), from several threads, and `onProgress` after each row. Cancelling
// leaves out the rows that have not begun.
void forEachRow(unsigned rowCount, const std::function<void(unsigned y)>& render,
                const OnProgress& onProgress);

} // namespace metamarch
