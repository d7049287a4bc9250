// SPDX-License-Identifier: MIT
// A clear sky with the sun, for scenes without any light of their own.
#pragma once
#include "metamarch/shading/light/environment.h"
#include "metamarch/shared/light.h"

#include <cstdint>

namespace metamarch {

struct SkySettings {
    float sunElevation = 0.785398163f; // radians above the horizon, -pi/2 to pi/2
    float sunAzimuth = 0.0f;           // radians from +x towards +z, like the map's columns
    float haze = 1.0f;                 // amount of aerosols, 1 on a clear day; at least 0
    glm::vec3 groundAlbedo{0.3f};      // of the plain that fills the map below the horizon
    // Number of columns and of rows of the map. The sky changes faster with the elevation than with the
    // azimuth, so a texel is twice as wide as high. What filtering adds is below 1e-3 of the radiance.
    std::uint32_t resolution = 512;

    bool operator==(const SkySettings&) const = default;
};

// The map holds the sky without the sun. The sun is a disc of 0.53 degrees with all the light that the air
// lets through. In these units of radiance, a white surface that faces the sun outside the atmosphere has
// radiance 1.
struct Sky {
    Environment environment;
    LightRecord sun; // a kLightDisc; its strength is 0 if it is below the horizon
};

// Computes the light that air and aerosols scatter once, with absorption by both and by ozone: T. Nishita et
// al., "Display of the Earth Taking into Account Atmospheric Scattering", 1993, with the coefficients of S.
// Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020. Multiple
// scattering is left out, so the sky is up to a third too dark, mostly near the horizon and at dusk.
Sky makeSky(const SkySettings& settings);

} // namespace metamarch
