// SPDX-License-Identifier: MIT
// Documents that follow from the declarations of commands and settings: what --help says, in other forms.
#pragma once
#include "metamarch/cli/command_line.h"

#include <string>

namespace metamarch::cli {

// Returns the source of the manual page, for man(7).
std::string manualPage(const Command& program, const std::string& version);

// Returns a script that completes the program's words in bash: sub-commands, options, the values of options
// that have a list of them, and files.
std::string bashCompletion(const Command& program);

} // namespace metamarch::cli
