// SPDX-License-Identifier: MIT
// The program: runs one sub-command and turns every failure into one line and an exit code.
#include "metamarch/cli/commands.h"
#include "metamarch/cli/version.h"
#include "metamarch/vulkan/context.h"

#include <fmt/format.h>

#include <cstdio>
#include <new>

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

Command makeProgram() {
    Command program{"metamarch", "Renders triangle scenes with Vulkan compute shaders.", {}, kFooter, {}, {}};
    program.commands.push_back(makeRenderCommand());
    program.commands.push_back(makeViewCommand());
    program.commands.push_back(makeInfoCommand());
    program.commands.push_back(makeCompareCommand());
    program.commands.push_back(makeBenchCommand());
    program.commands.push_back(makeDevicesCommand());
    return program;
}

// What sub-commands print stays in a buffer until here: a full disk may show only now.
void flushOutput() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw Error(ErrorKind::outputNotWritable, "cannot write to standard output");
    }
}

int run(const int argc, char** const argv) {
    Command program = makeProgram();
    const int code = runCommandLine(argc, argv, program, versionText());
    flushOutput();
    // Validation is for developers, and a message a defect of the program.
    return vulkan::validationMessages() == 0
               ? code
               : report(ExitCode::internalError, "the validation layer complained; see above");
}

} // namespace
} // namespace metamarch::cli

int main(int argc, char** argv) {
    using namespace metamarch;
    try {
        return cli::run(argc, argv);
    } catch (const Error& error) {
        return cli::report(error);
    } catch (const std::bad_alloc&) {
        return cli::report(cli::ExitCode::outOfMemory, "out of memory");
    } catch (const std::exception& error) {
        return cli::report(cli::ExitCode::internalError, fmt::format("internal error: {}", error.what()));
    }
}
