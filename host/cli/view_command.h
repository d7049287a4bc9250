// `metamarch view`: a scene in a window.
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

// Without the libraries of the window the sub-command says so: Error(noDevice).
void addViewCommand(CLI::App& program);

} // namespace metamarch::cli
