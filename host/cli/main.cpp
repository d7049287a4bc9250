// SPDX-License-Identifier: MIT
#include "metamarch/cli/program.h"

int main(const int argc, char** argv) { return metamarch::cli::runProgram(argc, argv); }
