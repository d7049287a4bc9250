// `metamarch render`: a scene file to a picture.
#pragma once
#include <CLI/CLI.hpp>

namespace metamarch::cli {

void addRenderCommand(CLI::App& program);

} // namespace metamarch::cli
