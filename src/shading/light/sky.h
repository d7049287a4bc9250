// A clear sky with its sun, for scenes that bring no light of their own.
#pragma once
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/light.h"

#include <cstdint>

namespace metamarch {

struct SkySettings {
    float sunElevation = 0.785398163f; // radians above the horizon, -pi/2 to pi/2
    float sunAzimuth = 0.0f;           // radians from +x towards +z, as the map's columns count
    float haze = 1.0f;                 // aerosols in units of a clear day's, at least 0
    glm::vec3 groundAlbedo{0.3f};      // of the plain that fills the map below the horizon
    std::uint32_t width = 1024;        // of the map, in texels; its height is half of that
};

// The map holds the sky without the sun, which is a disc of 0.53 degrees with all that the air lets pass.
// Radiance is in units in which a white surface that faces the sun outside the atmosphere has radiance 1.
struct Sky {
    Environment environment;
    LightRecord sun; // kLightDisc; of strength 0 below the horizon
};

// Light scattered once by air and aerosols, absorbed by both and by ozone: T. Nishita et al., "Display of the
// Earth Taking into Account Atmospheric Scattering", 1993, with the coefficients of S. Hillaire, "A Scalable
// and Production Ready Sky and Atmosphere Rendering Technique", 2020. Light scattered more often is left out,
// so the sky is up to a third too dark, most near the horizon and at dusk.
Sky makeSky(const SkySettings& settings);

} // namespace metamarch
