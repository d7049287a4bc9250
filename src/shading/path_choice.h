// What a user asks of the path tracer.
#pragma once
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shared/path_settings.h"

#include <cstdint>
#include <string>

namespace metamarch {

struct PathChoice {
    std::string integrator = "path"; // or direct, without bounces, or ao: white under a white sky
    std::uint32_t maxBounces = 8;
    std::uint32_t seed = 0;
    float clamp = 0.0f; // of the luminance that one way to a light adds to a sample; 0: no limit
    bool isSingleScatter = false;

    bool operator==(const PathChoice&) const = default;

    bool isOcclusion() const { return integrator == "ao"; }

    // `settings` are the scene's.
    PathSettings applied(PathSettings settings) const {
        settings.maxBounces = integrator == "path" ? maxBounces : 0;
        settings.seed = seed;
        settings.strategies = kSampleLights | kSampleBsdf;
        settings.clampLuminance = clamp;
        return settings;
    }

    ShadingOptions shading() const { return {.isSingleScatter = isSingleScatter, .isWhite = isOcclusion()}; }
};

} // namespace metamarch
