// SPDX-License-Identifier: MIT
// What a user asks of the path tracer.
#pragma once
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shared/path_settings.h"

#include <cstdint>
#include <string_view>
#include <utility>

namespace metamarch {

enum class Integrator {
    path,    // global illumination
    direct,  // light without bounces
    ao,      // ambient occlusion: white surfaces under a white sky
    primary, // what the camera sees, lit from the eye, at pixel centres
};

inline constexpr std::pair<std::string_view, Integrator> kIntegrators[] = {{"path", Integrator::path},
                                                                           {"direct", Integrator::direct},
                                                                           {"ao", Integrator::ao},
                                                                           {"primary", Integrator::primary}};

constexpr std::string_view nameOf(const Integrator integrator) {
    return kIntegrators[static_cast<int>(integrator)].first;
}

enum class Brdf {
    compensated, // rough surfaces keep the energy that single scattering loses
    gltf,        // single scattering, to the letter of glTF 2.0, Appendix B
};

inline constexpr std::pair<std::string_view, Brdf> kBrdfs[] = {{"compensated", Brdf::compensated},
                                                               {"gltf", Brdf::gltf}};

// Float sums of more samples would no longer grow; dimensions of more bounces would pass 2^32.
inline constexpr std::uint32_t kMostSamples = 1u << 24u;
inline constexpr std::uint32_t kMostBounces = 1u << 16u;

struct PathChoice {
    Integrator integrator = Integrator::path;
    std::uint32_t maxBounces = 8;
    std::uint32_t seed = 0;
    float clamp = 0.0f; // of the luminance that one way to a light adds to a sample; 0: no limit
    Brdf brdf = Brdf::compensated;

    bool operator==(const PathChoice&) const = default;

    bool isOcclusion() const { return integrator == Integrator::ao; }

    // `settings` are the scene's.
    PathSettings applied(PathSettings settings) const {
        settings.maxBounces = integrator == Integrator::path ? maxBounces : 0;
        settings.seed = seed;
        settings.strategies = kSampleLights | kSampleBsdf;
        settings.clampLuminance = clamp;
        return settings;
    }

    ShadingOptions shading() const {
        return {.isSingleScatter = brdf == Brdf::gltf, .isWhite = isOcclusion()};
    }
};

} // namespace metamarch
