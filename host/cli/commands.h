// SPDX-License-Identifier: MIT
// The sub-commands of the program.
#pragma once
#include "metamarch/cli/command_line.h"

namespace metamarch::cli {

Command makeRenderCommand();         // a scene file to a picture
Command makeMergeCommand();          // parts of a picture to the picture
Command makeViewCommand();           // a scene in a window
Command makeInfoCommand();           // what a scene is and what tree and table over it cost
Command makeCompareCommand();        // how far apart two pictures are
Command makeBenchCommand();          // the two below, and lists
Command makeBenchTraversalCommand(); // every traversal on the same rays
Command makeBenchPaperCommand();     // the paper's experiment
Command makeDevicesCommand();        // every Vulkan device, with its limits or why it is refused

} // namespace metamarch::cli
