// SPDX-License-Identifier: MIT
// The exit codes of the program; `metamarch --help` lists them.
#pragma once
#include "metamarch/error/error.h"

namespace metamarch::cli {

enum class ExitCode {
    done = 0,
    outOfBounds = 1,
    badArguments = 2,
    inputRefused = 3,
    noDevice = 4,
    outputNotWritable = 5,
    outOfMemory = 6,
    internalError = 70, // a defect of the program (EX_SOFTWARE of sysexits.h)
};

constexpr ExitCode exitCodeOf(const ErrorKind kind) {
    switch (kind) {
    case ErrorKind::invalidArgument:
        return ExitCode::badArguments;
    case ErrorKind::inputRefused:
        return ExitCode::inputRefused;
    case ErrorKind::noDevice:
        return ExitCode::noDevice;
    case ErrorKind::outputNotWritable:
        return ExitCode::outputNotWritable;
    case ErrorKind::outOfMemory:
        return ExitCode::outOfMemory;
    case ErrorKind::mismatch:
        return ExitCode::outOfBounds;
    }
    return ExitCode::internalError;
}

} // namespace metamarch::cli
