// The one exception of the project and the exit codes of the program.
#pragma once
#include <stdexcept>
#include <string>

namespace metamarch {

enum class ExitCode {
    done = 0,
    comparisonFailed = 1,
    badArguments = 2,
    sceneRefused = 3, // unreadable or refused
    noDevice = 4,     // no usable device, or device lost
    outputNotWritable = 5,
    outOfMemory = 6, // out of memory or over a limit
};

// One line for the user: what, where, and what to do about it. main() prints it and exits with `code`.
class Error : public std::runtime_error {
  public:
    Error(ExitCode exitCode, const std::string& line) : std::runtime_error(line), code(exitCode) {}

    const ExitCode code;
};

} // namespace metamarch
