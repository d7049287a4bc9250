// SPDX-License-Identifier: MIT
// Standard output and standard error: everything that the program prints goes through here. A stream may be
// closed, or a log on a full disk. That ends no program and costs no picture, so nothing here throws.
#pragma once
#include <string_view>

namespace metamarch {

// Prints a result on standard output; it may wait in a buffer until flushResults().
void printResult(std::string_view text) noexcept;

// Writes the waiting results. Returns false if any result could not be written, in this call or an earlier
// one. A reader that closes its pipe early is no failure: it has read what it wants (`| head`).
bool flushResults() noexcept;

// Prints a line for the user on standard output that is not a result, such as a summary. A failure to write
// it is ignored.
void printSummary(std::string_view text) noexcept;

// Prints on standard error, where warnings and errors go.
void printError(std::string_view text) noexcept;

} // namespace metamarch
