// SPDX-License-Identifier: MIT
// Prepares standard streams and signals before the program does anything else.
#pragma once

namespace metamarch::cli {

// After the call:
//   - the descriptors 0 to 2 are open, so no file that the program opens is taken for a standard stream;
//   - a pipe without a reader and a file that may not grow fail the write, and do not end the program;
//   - SIGHUP, SIGINT and SIGTERM end it with 128 + their number and leave no temporary file behind, also as
//     process 1 of a container, for which the kernel ignores signals without a handler;
//   - SIGUSR1 does nothing: see SignalWatch;
//   - an exception in a thread that nobody can catch prints its line and ends with an exit code.
void initProcess();

// While it lives, the first of SIGHUP, SIGINT and SIGTERM does not end the program but is remembered, so that
// results can be written; the second ends it. SIGUSR1 is always only remembered. One of them at a time.
class SignalWatch {
  public:
    SignalWatch();
    ~SignalWatch();
    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;

    int ending() const; // the signal that came; 0: none

    // Whether SIGUSR1 has come since the last call.
    bool takeUserSignal();
};

// Ends the program by the signal, as it would have ended it without a SignalWatch.
[[noreturn]] void endBy(int signal);

} // namespace metamarch::cli
