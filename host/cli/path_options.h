// The options of the path tracer.
#pragma once
#include "scene/shading_builder.h"
#include "shared/path_settings.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>

namespace metamarch::cli {

class PathOptions {
  public:
    void addTo(CLI::App& command);

    // Throws Error(badArguments) for values out of range.
    void check() const;

    std::uint32_t samples() const { return spp; }

    // `settings` are the scene's; `integrator` is path, direct or ao.
    PathSettings apply(PathSettings settings, const std::string& integrator) const;

    ShadingOptions shading(const std::string& integrator) const;

  private:
    std::uint32_t spp = 64;
    std::uint32_t seed = 0;
    std::uint32_t maxBounces = 8;
    double clamp = 0.0;
    std::string brdf = "compensated";
};

} // namespace metamarch::cli
