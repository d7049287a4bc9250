// `metamarch bench traversal SCENE...`
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

void addBenchTraversalCommand(CLI::App& bench);

} // namespace metamarch::cli
