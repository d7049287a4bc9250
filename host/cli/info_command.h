// `metamarch info`: what a scene is and what tree and table over it cost.
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

void addInfoCommand(CLI::App& program);

} // namespace metamarch::cli
