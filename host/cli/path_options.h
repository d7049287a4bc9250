// The options of the path tracer.
#pragma once
#include "metamarch/shading/path_choice.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

namespace metamarch::cli {

class PathOptions {
  public:
    explicit PathOptions(std::uint32_t defaultSamples) : spp(defaultSamples) {}

    void addTo(CLI::App& command);

    // Throws Error(invalidArgument) for values out of range.
    void check() const;

    std::uint32_t samples() const { return spp; }

    // `integrator` is path, direct or ao.
    PathChoice parse(const std::string& integrator) const;

  private:
    std::uint32_t spp;
    PathChoice choice;
    double clamp = 0.0;
    std::string brdf = "compensated";
};

} // namespace metamarch::cli
