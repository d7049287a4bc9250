// SPDX-License-Identifier: MIT
// The user's choices for the path tracer.
#pragma once
#include "metamarch/shading/shading_builder.h"
#include "metamarch/shared/path_settings.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace metamarch {

enum class Integrator {
    path,    // global illumination
    direct,  // direct light only
    ao,      // ambient occlusion: white surfaces under a white sky
    primary, // one ray through each pixel's centre, lit by a lamp at the eye
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
    gltf,        // single scattering, exactly as in glTF 2.0, Appendix B
};

inline constexpr std::pair<std::string_view, Brdf> kBrdfs[] = {{"compensated", Brdf::compensated},
                                                               {"gltf", Brdf::gltf}};

// Limits: a float that counts more samples would no longer grow, and the dimensions of more bounces could
// exceed 2^32.
inline constexpr std::uint32_t kMostSamples = 1u << 24u;
inline constexpr std::uint32_t kMostBounces = 1u << 16u;

struct PathChoice {
    Integrator integrator = Integrator::path;
    std::uint32_t maxBounces = 8;
    std::uint32_t seed = 0;
    float clamp = 0.0f; // largest luminance of one contribution to a sample: see clampedGain; 0: no limit
    Brdf brdf = Brdf::compensated;
    bool isTransparent = false;          // the camera does not see what is all around
    std::uint32_t catcher = kNoMaterial; // the material whose surfaces only catch shadow
    // Roughness of a polish, of refractive index 1.5, in which the catcher mirrors objects; none: no polish
    std::optional<float> catcherReflection{};

    bool operator==(const PathChoice&) const = default;

    bool hasCatcher() const { return catcher != kNoMaterial; }
    bool isOcclusion() const { return integrator == Integrator::ao; }

    // Returns `settings`, which the scene has set, with these choices.
    PathSettings applied(PathSettings settings) const {
        settings.maxBounces = integrator == Integrator::path ? maxBounces : 0;
        settings.seed = seed;
        settings.strategies = kSampleLights | kSampleBsdf | (isTransparent ? kHideSurroundings : 0u);
        settings.clampLuminance = clamp;
        return settings;
    }

    ShadingOptions shading() const {
        return {.isSingleScatter = brdf == Brdf::gltf,
                .isWhite = isOcclusion(),
                .catcher = catcher,
                .catcherReflection = catcherReflection};
    }
};

} // namespace metamarch
