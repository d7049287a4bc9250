// SPDX-License-Identifier: MIT
// The project's only exception.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace metamarch {

enum class ErrorKind {
    invalidArgument,   // a value is out of range, or values exclude each other
    inputRefused,      // a file cannot be read, or its content is wrong
    noDevice,          // there is no usable device, or the device was lost
    outputNotWritable, // a file cannot be written
    outOfMemory,       // memory ran out, or a limit was exceeded
    mismatch,          // two results that should agree do not
};

// The message is one line for the user: what is wrong, where, and what to do about it. `settings` names the
// settings that the user may change ("treeDepth"); each front end translates them into its own spelling
// ("--tree-depth").
class Error : public std::runtime_error {
  public:
    Error(const ErrorKind errorKind, const std::string& line, std::vector<std::string> settingNames = {})
        : std::runtime_error(line), kind(errorKind), settings(std::move(settingNames)) {}

    ErrorKind kind;
    std::vector<std::string> settings;
};

} // namespace metamarch
