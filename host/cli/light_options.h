// The options for light that does not come from the scene's file.
#pragma once
#include "metamarch/shading/light_choice.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace metamarch::cli {

class LightOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range and for options that exclude each other.
    void check() const;

    LightChoice parse() const;

  private:
    std::string environment;
    double rotation = 0.0; // degrees
    std::optional<double> intensity;
    std::string background;
    bool sky = false;
    std::string sun;
};

} // namespace metamarch::cli
