// `metamarch bench paper --scenes DIR --out DIR`
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

void addBenchPaperCommand(CLI::App& bench);

} // namespace metamarch::cli
