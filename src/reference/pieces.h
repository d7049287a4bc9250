// SPDX-License-Identifier: MIT
// Renders pictures piece by piece, rows or tiles, on all cores.
#pragma once
#include <functional>

namespace metamarch {

// Receives the finished fraction of a picture, which rises to 1. No two calls run at the same time. If it
// returns false, the rest of the picture is cancelled. The function may be empty.
using OnProgress = std::function<bool(double part)>;

// Calls `render` for each of [0, pieceCount), from several threads, and `onProgress` after each piece.
// Cancelling leaves out the pieces that have not begun. Returns false if any are left out.
bool forEachPiece(unsigned pieceCount, const std::function<void(unsigned piece)>& render,
                  const OnProgress& onProgress);

} // namespace metamarch
