// SPDX-License-Identifier: MIT
// Prepares standard streams and signals before the program does anything else.
#pragma once

namespace metamarch::cli {

// After the call:
//   - the descriptors 0 to 2 are open, so no file that the program opens is taken for a standard stream;
//   - a pipe without a reader and a file that may not grow fail the write, and do not end the program;
//   - SIGHUP, SIGINT and SIGTERM end it with 128 + their number and leave no temporary file behind, also as
//     process 1 of a container, for which the kernel ignores signals without a handler;
//   - an exception in a thread that nobody can catch prints its line and ends with an exit code.
void initProcess();

} // namespace metamarch::cli
