// SPDX-License-Identifier: MIT
// The program without its main function, so that tests can run it too.
#pragma once
#include "metamarch/cli/command_line.h"

namespace metamarch::cli {

// The program with all its sub-commands.
Command makeProgram();

// Runs the sub-command that the arguments name. Turns every failure into one line on stderr and an exit code.
// Sets up signals and streams of the whole process.
int runProgram(int argc, const char* const* argv);

} // namespace metamarch::cli
