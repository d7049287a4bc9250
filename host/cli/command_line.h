// SPDX-License-Identifier: MIT
// The command line: sub-commands with their settings. CLI11 parses it; no other file includes CLI11.
#pragma once
#include "metamarch/cli/exit_code.h"
#include "metamarch/settings/setting.h"

#include <functional>
#include <string>
#include <vector>

namespace metamarch::cli {

struct Command {
    std::string name;
    std::string summary;
    SettingList settings;
    std::string footer;
    std::function<void(const SettingList&)> run; // called once the settings have their values
    std::vector<Command> commands;
};

// Parses the arguments, runs the sub-command that they name and returns the exit code. Prints help, version
// and what is wrong with the arguments; throws what `run` throws.
int runCommandLine(int argc, const char* const* argv, Command& program, const std::string& version);

// Print "metamarch: LINE" on stderr and return the exit code. The options of an error's settings follow its
// line.
int report(ExitCode code, const std::string& line);
int report(const Error& error);

// The same for the exception that is being handled. Reports a defect if there is none.
int reportCurrentException();

} // namespace metamarch::cli
