// SPDX-License-Identifier: MIT
// The window's title: the file, what is seen of it, and what the window waits for.
#pragma once
#include "metamarch/viewer/viewer_state.h"

#include <string>

namespace metamarch::viewer {

// `isPreparing`: the window waits for the driver.
std::string titleText(const ViewerState& state, bool isPreparing);

} // namespace metamarch::viewer
