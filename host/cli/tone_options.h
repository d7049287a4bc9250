// The options that say how light becomes the 8 bits of a PNG.
#pragma once
#include "metamarch/image/tone_mapping.h"

#include <CLI/CLI.hpp>

#include <string>

namespace metamarch::cli {

class ToneOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range.
    void check() const;

    // `integrator` primary is shown as it is where nothing is asked for.
    ToneMapping parse(const std::string& integrator) const;

  private:
    std::string toneMap; // empty: by the integrator
    double exposure = 0.0;
};

} // namespace metamarch::cli
