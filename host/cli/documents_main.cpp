// SPDX-License-Identifier: MIT
// metamarch_documents FOLDER: writes the manual page and the completion of bash, which are installed.
#include "metamarch/cli/command_line.h"
#include "metamarch/cli/documents.h"
#include "metamarch/cli/program.h"
#include "metamarch/cli/version.h"
#include "metamarch/file/output_file.h"

#include <filesystem>
#include <string>

namespace {

void write(const std::filesystem::path& folder) {
    const metamarch::cli::Command program = metamarch::cli::makeProgram();
    const std::string version = metamarch::cli::programVersion();
    metamarch::writeText(folder / "metamarch.1",
                         metamarch::cli::manualPage(program, version.substr(0, version.find(" ("))));
    metamarch::writeText(folder / "metamarch.bash", metamarch::cli::bashCompletion(program));
}

} // namespace

int main(const int argc, char** argv) {
    try {
        write(argc > 1 ? argv[1] : ".");
        return 0;
    } catch (...) {
        return metamarch::cli::reportCurrentException();
    }
}
