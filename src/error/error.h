// The one exception of the project.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace metamarch {

enum class ErrorKind {
    invalidArgument,   // a value out of range, or values that exclude each other
    inputRefused,      // a file that cannot be read, or whose content is wrong
    noDevice,          // no usable device, or the device was lost
    outputNotWritable, // a file cannot be written
    outOfMemory,       // out of memory, or over a limit
    mismatch,          // two results that should agree do not
};

// One line for the user: what, where, and what to do about it. `settings` names the fields that the user may
// change ("treeDepth"); each front end adds its own spelling of them ("--tree-depth").
class Error : public std::runtime_error {
  public:
    Error(const ErrorKind errorKind, const std::string& line, std::vector<std::string> settingNames = {})
        : std::runtime_error(line), kind(errorKind), settings(std::move(settingNames)) {}

    ErrorKind kind;
    std::vector<std::string> settings;
};

} // namespace metamarch
