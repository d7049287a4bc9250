#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

// metamarch compare A B: how far apart two pictures are.
void addCompareCommand(CLI::App& program);

} // namespace metamarch::cli
