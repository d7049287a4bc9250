// SPDX-License-Identifier: MIT
#include "metamarch/cli/program.h"

#include "metamarch/cli/commands.h"
#include "metamarch/cli/process.h"
#include "metamarch/cli/version.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/vulkan/context.h"

namespace metamarch::cli {
namespace {

constexpr const char* kFooter = "Exit codes:\n"
                                "   0  done; for compare: within bounds\n"
                                "   1  compare: out of bounds\n"
                                "   2  bad arguments\n"
                                "   3  scene, picture or partition unreadable or refused\n"
                                "   4  no usable device, or device lost\n"
                                "   5  output not writable\n"
                                "   6  out of memory or over a limit\n"
                                "  70  internal error\n"
                                "Anything but 0 comes with one line on stderr.\n\n"
                                "Example:\n"
                                "  build/metamarch devices";

int parseAndRun(const int argc, const char* const* const argv) {
    Command program = makeProgram();
    const int code = runCommandLine(argc, argv, program, versionText());
    if (!flushResults() && code == static_cast<int>(ExitCode::done)) { // a full disk may show only now
        throw Error(ErrorKind::outputNotWritable, "cannot write to standard output");
    }
    // Only developers switch validation on. A message of it is a defect of the program.
    return vulkan::validationMessages() == 0
               ? code
               : report(ExitCode::internalError, "the validation layer complained; see above");
}

} // namespace

Command makeProgram() {
    Command program{"metamarch", "Renders triangle scenes with Vulkan compute shaders.", {}, kFooter, {}, {}};
    program.commands.push_back(makeRenderCommand());
    program.commands.push_back(makeMergeCommand());
    program.commands.push_back(makeViewCommand());
    program.commands.push_back(makeInfoCommand());
    program.commands.push_back(makeCompareCommand());
    program.commands.push_back(makeBenchCommand());
    program.commands.push_back(makeDevicesCommand());
    return program;
}

int runProgram(const int argc, const char* const* const argv) {
    initProcess();
    try {
        return parseAndRun(argc, argv);
    } catch (...) {
        return reportCurrentException();
    }
}

} // namespace metamarch::cli
