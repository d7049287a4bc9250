// The options for light that does not come from the scene's file.
#pragma once
#include "scene/shading_builder.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace metamarch::cli {

class LightOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(badArguments) for values out of range and for options that exclude each other.
    void check() const;

    // Reads the map or makes the sky. `sceneHasLight`: else a scene that is given no light gets the default
    // sky, with a warning. Throws what loadEnvironment throws.
    Surroundings load(const std::string& scenePath, bool sceneHasLight) const;

  private:
    std::string environment;
    double rotation = 0.0; // degrees
    std::optional<double> intensity;
    std::string background;
    bool sky = false;
    std::string sun;
};

} // namespace metamarch::cli
