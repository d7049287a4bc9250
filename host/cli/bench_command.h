// `metamarch bench`: measurements; bench_traversal_command.h and bench_paper_command.h say of what.
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

void addBenchCommand(CLI::App& program);

} // namespace metamarch::cli
