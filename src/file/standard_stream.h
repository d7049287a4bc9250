// SPDX-License-Identifier: MIT
// Standard output and standard error: everything that the program prints goes through here. A stream may be
// closed, or a log on a full disk. That ends no program and costs no picture, so nothing here throws.
#pragma once
#include <string_view>

namespace metamarch {

// Prints a result on standard output; it may wait in a buffer until flushResults().
void printResult(std::string_view text) noexcept;

// Returns false where a part of the results is lost, now or before. Where the reader of a pipe has read
// enough and left, nothing is.
bool flushResults() noexcept;

// Prints on standard output what the program says beside its results. What is lost of it is not missed.
void printRemark(std::string_view text) noexcept;

// Prints on standard error, where warnings and errors go.
void printError(std::string_view text) noexcept;

} // namespace metamarch
