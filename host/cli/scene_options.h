// The options that say what of a scene file is wanted, the same for every sub-command that reads one.
#pragma once
#include "metamarch/scene/import.h"

#include <CLI/CLI.hpp>

namespace metamarch::cli {

class SceneOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range.
    ImportOptions parse() const;

  private:
    double scale = 1.0;
    ImportOptions options;
};

} // namespace metamarch::cli
